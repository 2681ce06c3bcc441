#include "mms/mapping/free_space/scan_sight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/mapping/synthetic_cloud.hpp"
#include "tests/mapping/synthetic_scan.hpp"

namespace mms {
namespace {

using test::hall_scan;
using test::pose;
using test::StandingBox;

constexpr double kMargin = 0.15;
const StandingBox kPerson{{3.8, -0.25, -1.0}, {4.2, 0.25, 0.75}};

/// Whether a scan from that pose saw through `point` (world frame [m]).
bool sees(const ScanSight& sight, const Transform<World, Sensor>& T_world_sensor,
          const Eigen::Vector3d& point) {
  return sight.sees_through((T_world_sensor.inverse() * point).cast<float>());
}

/// A random point on the hall's floor, ceiling or walls, or on a side of the box.
class SurfacePoints {
 public:
  Eigen::Vector3d on(const StandingBox& box) {
    Eigen::Vector3d point;
    for (int i = 0; i < 3; ++i) point(i) = uniform_(random_);
    const int axis = side_(random_);
    point(axis) = std::round(point(axis));
    return box.low + point.cwiseProduct(box.high - box.low);
  }

 private:
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
  std::uniform_int_distribution<int> side_{0, 2};
};

TEST(ScanSight, DoesNotSeeThroughStaticSurfaces) {
  const StandingBox hall{{-8.0, -8.0, -1.0}, {8.0, 8.0, 4.0}};
  const StandingBox pallet{{2.0, 1.0, -1.0}, {3.2, 1.8, -0.4}};
  SurfacePoints points;
  for (const double turn : {0.0, 0.3, 0.8}) {
    const auto T = pose({0.7, -0.4, 0.1}, turn);
    const ScanSight sight(hall_scan({pallet}, T), kMargin);
    for (int i = 0; i < 20'000; ++i) {
      const Eigen::Vector3d wall = points.on(hall);
      EXPECT_FALSE(sees(sight, T, wall)) << wall.transpose();
    }
    int wrong = 0;  // edges that no ring hits
    for (int i = 0; i < 20'000; ++i) wrong += sees(sight, T, points.on(pallet));
    EXPECT_LT(wrong, 200);
  }
}

TEST(ScanSight, MaySeeIntoBallsWithPointsSeenThrough) {
  const ScanSight sight(hall_scan({kPerson}, pose({0.7, -0.4, 0.1}, 0.3)), kMargin);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-12.0F, 12.0F);
  std::uniform_real_distribution<float> size(0.05F, 1.5F);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  int culled = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3f center(place(random), place(random), 0.3F * place(random));
    const float radius = size(random);
    if (sight.may_see_into(center, radius)) continue;
    ++culled;
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3f offset(unit(random), unit(random), unit(random));
      if (offset.norm() > 1.0F) continue;
      EXPECT_FALSE(sight.sees_through(center + radius * offset)) << center.transpose();
    }
  }
  EXPECT_GT(culled, 5000);
}

TEST(ScanSight, SeesThroughFormerPosition) {
  const auto T = pose({0.0, 0.0, 0.0});
  const ScanSight sight(hall_scan({}, T), kMargin);
  SurfacePoints points;
  int high = 0;
  int seen = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d point = points.on(kPerson);
    if (point.z() < -0.6) continue;  // below, the rings hit the floor
    ++high;
    seen += sees(sight, T, point);
  }
  EXPECT_GT(seen, 0.9 * high);
}

TEST(ScanSight, DoesNotSeeBehindOrCloseToPerson) {
  const auto T = pose({0.0, 0.0, 0.0});
  const ScanSight sight(hall_scan({kPerson}, T), kMargin);
  const ScanSight empty(hall_scan({}, T), kMargin);
  const Eigen::Vector3d behind(6.0, 0.1, 0.1);
  const Eigen::Vector3d beside(3.8, 0.27, 0.1);
  const Eigen::Vector3d away(3.8, 0.4, 0.1);
  EXPECT_FALSE(sees(sight, T, behind));
  EXPECT_FALSE(sees(sight, T, beside));
  EXPECT_TRUE(sees(sight, T, away));
  for (const Eigen::Vector3d& point : {behind, beside, away}) EXPECT_TRUE(sees(empty, T, point));
}

TEST(ScanSight, SeesNothingBeyondRingsOrWithoutReturns) {
  const auto T = pose({0.0, 0.0, 0.0});
  LabeledCloud scan = hall_scan({}, T);
  const Eigen::Vector3d above(1.0, 0.0, 0.5);  // 27 degrees, the last ring has 15
  EXPECT_FALSE(sees(ScanSight(scan, kMargin), T, above));
  const Eigen::Vector3d ahead(3.0, 0.1, 0.1);
  EXPECT_TRUE(sees(ScanSight(scan, kMargin), T, ahead));
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (scan.points[i].x() > 0.0F) scan.labels[i] = PointLabel::kInvalid;
  }
  EXPECT_FALSE(sees(ScanSight(scan, kMargin), T, ahead));
  EXPECT_FALSE(sees(ScanSight(LabeledCloud{}, kMargin), T, ahead));
}

TEST(ScanSight, IgnoresInvalidPoints) {
  const auto T = pose({0.0, 0.0, 0.0});
  LabeledCloud scan = hall_scan({}, T);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  for (const Eigen::Vector3f& invalid :
       {Eigen::Vector3f(kNan, 0, 0), Eigen::Vector3f(kInf, 0, 0), Eigen::Vector3f(kInf, -kInf, 1),
        Eigen::Vector3f(0, 0, 0)}) {
    scan.points.push_back(invalid);
    scan.labels.push_back(PointLabel::kStatic);
  }
  const ScanSight sight(scan, kMargin);
  EXPECT_TRUE(sees(sight, T, {3.0, 0.1, 0.1}));
  EXPECT_TRUE(sees(sight, T, {0.1, 3.0, 0.1}));
  EXPECT_FALSE(sees(sight, T, {9.0, 0.1, 0.1}));
}

TEST(ScanSight, MaySeeIntoSpheresWithFreeCenter) {
  const auto T = pose({0.0, 0.0, 0.0});
  const ScanSight sight(hall_scan({}, T), kMargin);
  EXPECT_TRUE(sight.may_see_into({6.0F, 0.1F, 0.1F}, 0.1F));
  EXPECT_TRUE(sight.may_see_into({7.9F, 0.1F, 0.1F}, 0.1F));
  EXPECT_FALSE(sight.may_see_into({8.1F, 0.1F, 0.1F}, 0.1F));
}

}  // namespace
}  // namespace mms
