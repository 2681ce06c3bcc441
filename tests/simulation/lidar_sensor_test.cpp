#include "mms/simulation/sensors/lidar_sensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "mms/core/hash_noise.hpp"
#include "mms/simulation/sensors/sensor_preset.hpp"

namespace mms {
namespace {

constexpr double kPeriod = 0.1;

LidarSensor lidar_of(const char* name) {
  return *sensor_preset(name).lidar;
}

double elevation_of(const Beam& beam) {
  return std::asin(static_cast<double>(beam.direction.z()));
}
double azimuth_of(const Beam& beam) {
  return std::atan2(static_cast<double>(beam.direction.y()),
                    static_cast<double>(beam.direction.x()));
}

class LidarPreset : public testing::TestWithParam<const char*> {};

TEST_P(LidarPreset, BeamsAreUnitVectorsOrderedByTime) {
  for (const int index : {0, 1, 17, 5000}) {
    const std::vector<Beam> shots = beams(lidar_of(GetParam()), index, kPeriod);
    EXPECT_TRUE(std::is_sorted(shots.begin(), shots.end(), [](const Beam& a, const Beam& b) {
      return a.time_offset < b.time_offset;
    }));
    EXPECT_GE(shots.front().time_offset, 0.0F);
    EXPECT_LT(static_cast<double>(shots.back().time_offset), kPeriod);
    EXPECT_GT(static_cast<double>(shots.back().time_offset), 0.99 * kPeriod);
    for (const Beam& beam : shots) ASSERT_NEAR(beam.direction.norm(), 1.0F, 1e-5F);
  }
}

TEST_P(LidarPreset, ScansAreRepeatableAndDifferent) {
  const auto sum = [](const std::vector<Beam>& shots) {
    Eigen::Vector3d total = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < shots.size(); i += 7) total += shots[i].direction.cast<double>();
    return std::pair(total.x(), total.y());
  };
  std::set<std::pair<double, double>> sums;
  for (int index = 0; index < 100; ++index) {
    sums.insert(sum(beams(lidar_of(GetParam()), index, kPeriod)));
  }
  EXPECT_EQ(sums.size(), 100U);
  EXPECT_TRUE(sums.contains(sum(beams(lidar_of(GetParam()), 42, kPeriod))));
}

INSTANTIATE_TEST_SUITE_P(All, LidarPreset, testing::Values("lidar16", "lidar64", "livox"));

TEST(LidarSensor, SpinningLidarCoversFullTurnWithAllRings) {
  const LidarSensor lidar = lidar_of("lidar16");
  const std::vector<Beam> shots = beams(lidar, 3, kPeriod);
  ASSERT_EQ(shots.size(), 16U * 1800U);
  std::set<int> azimuths;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const std::size_t ring = i % 16;
    EXPECT_EQ(shots[i].time_offset, shots[i - ring].time_offset);
    EXPECT_NEAR(elevation_of(shots[i]), 0.2617994 - static_cast<double>(ring) * 0.0349066, 1e-5);
    azimuths.insert(static_cast<int>(std::floor(azimuth_of(shots[i]) * 57.29578)));
  }
  EXPECT_GE(azimuths.size(), 360U);
  EXPECT_GT(azimuth_of(shots[16]), azimuth_of(shots[16 * 5]));
}

TEST(LidarSensor, RosetteFillsFieldScanByScan) {
  const LidarSensor lidar = lidar_of("livox");
  constexpr int kCells = 60;
  std::set<int> hit;
  double inside = 0.0;
  for (int i = 0; i < kCells * kCells; ++i) {
    const double x = (i % kCells + 0.5) / kCells * 2.0 - 1.0;
    const double y = (static_cast<int>(i / kCells) + 0.5) / kCells * 2.0 - 1.0;
    if (x * x + y * y < 1.0) inside += 1.0;
  }
  std::vector<double> shares;
  for (int index = 0; index < 10; ++index) {
    for (const Beam& beam : beams(lidar, index, kPeriod)) {
      const double off_axis = std::acos(std::min(static_cast<double>(beam.direction.x()), 1.0));
      EXPECT_LE(off_axis, lidar.field + 1e-3);
      const double side = 2.001 * std::sin(lidar.field) / kCells;
      hit.insert(static_cast<int>(beam.direction.y() / side + kCells / 2.0) +
                 kCells * static_cast<int>(beam.direction.z() / side + kCells / 2.0));
    }
    shares.push_back(static_cast<double>(hit.size()) / inside);
  }
  EXPECT_LT(shares[0], 0.7);
  EXPECT_GT(shares[1], shares[0] + 0.08);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GT(shares[9], 0.95);
}

TEST(LidarSensor, RosetteContinuesAcrossScans) {
  const LidarSensor lidar = lidar_of("livox");
  const Beam last = beams(lidar, 7, kPeriod).back();
  const Beam next = beams(lidar, 8, kPeriod).front();
  EXPECT_LT((last.direction - next.direction).norm(), 0.01F);
}

TEST(LidarSensor, RangeHasNoiseWithoutBias) {
  const LidarSensor lidar = lidar_of("lidar16");
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 50000;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const float range = measured_range(12.0F, 0.9F, 0.5F, 0.0F, lidar, hash_of(5, i));
    ASSERT_GT(range, 0.0F);
    sum += static_cast<double>(range) - 12.0;
    squares += (static_cast<double>(range) - 12.0) * (static_cast<double>(range) - 12.0);
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.0005);
  EXPECT_NEAR(std::sqrt(squares / kCount), lidar.noise, 0.001);
}

/// Share of returns.
double returns(float range, float cosine, float reflectance, float gloss) {
  const LidarSensor lidar = lidar_of("livox");
  int count = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const float measured = measured_range(range, cosine, reflectance, gloss, lidar, hash_of(9, i));
    EXPECT_TRUE(measured == 0.0F || (measured >= lidar.min_range && measured <= lidar.max_range));
    if (measured != 0.0F) ++count;
  }
  return count / 2000.0;
}

TEST(LidarSensor, DetectionFollowsReturnedLight) {
  EXPECT_EQ(returns(10.0F, 1.0F, 0.5F, 0.0F), 1.0);
  EXPECT_GT(returns(70.0F, 1.0F, 0.1F, 0.0F), 0.9);  // the data sheet: 90 m at 10 %
  EXPECT_LT(returns(100.0F, 1.0F, 0.1F, 0.0F), 0.1);
  EXPECT_GT(returns(105.0F, 1.0F, 0.2F, 0.0F), 0.9);  // 130 m at 20 %
  EXPECT_LT(returns(140.0F, 1.0F, 0.2F, 0.0F), 0.1);
  EXPECT_LT(returns(70.0F, 0.3F, 0.1F, 0.0F), 0.1);
  EXPECT_EQ(returns(10.0F, 0.01F, 0.9F, 0.0F), 0.0);
  EXPECT_EQ(returns(10.0F, 0.6F, 0.9F, 1.0F), 0.0);
  EXPECT_EQ(returns(10.0F, 1.0F, 0.9F, 1.0F), 1.0);
}

TEST(LidarSensor, NoReturnForInvalidOrDistantRange) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float range : {nan, infinite, -1.0F, 0.0F, 0.3F, 261.0F}) {
    EXPECT_EQ(returns(range, 1.0F, 1.0F, 0.0F), 0.0) << range;
  }
  EXPECT_EQ(returns(5.0F, nan, 1.0F, 0.0F), 0.0);
  EXPECT_EQ(returns(5.0F, 1.0F, nan, 0.0F), 0.0);
  EXPECT_EQ(returns(5.0F, 1.0F, 1.0F, nan), 1.0);
}

}  // namespace
}  // namespace mms
