// Which views the global map keeps of a place that is visited again and again.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mms/global_map/global_map.hpp"

namespace mms {
namespace {

constexpr int kPerLap = 16;  // keyframes, 0.39 m apart; a lap has 6.2 m

/// Views that are too poor for a loop, along a circle of 1 m, all in one direction.
KeyframeRecord record_at(int i) {
  const double angle = 2.0 * std::numbers::pi * i / kPerLap;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(std::cos(angle), 0.0, std::sin(angle));
  KeyframeRecord record;
  record.stamp = Timestamp((i + 1) * 500'000'000LL);
  record.T_world_sensor = Transform<World, Sensor>(pose);
  record.features.planes.push_back(
      {.point = {0.0F, 0.0F, 2.0F}, .normal = {0.0F, 0.0F, -1.0F}, .sigma = 0.01F});
  constexpr int kWidth = 8;
  constexpr int kHeight = 6;
  record.view.camera = {8.0, 8.0, 3.5, 2.5, kWidth, kHeight, {}};
  record.view.depth_mm = Image<std::uint16_t>(kWidth, kHeight);
  record.view.is_static = Image<std::uint8_t>(kWidth, kHeight);
  return record;
}

/// The map after some laps, with an accepted loop of the last keyframe to that of a lap before.
GlobalMap map_of_laps(int laps, bool has_loop) {
  GlobalMapContent content;
  const int count = laps * kPerLap;
  for (int i = 0; i < count; ++i) {
    content.records.push_back(record_at(i));
    content.poses.push_back(content.records.back().T_world_sensor.isometry());
  }
  if (has_loop) {
    Loop loop;
    loop.query = static_cast<std::size_t>(count - 1);
    loop.candidate = loop.query - kPerLap;
    loop.outcome = LoopOutcome::kAccepted;
    loop.information = 1e4 * Matrix6d::Identity();
    content.loops = {loop};
  }
  GlobalMap map(GlobalMapConfig{}, FeatureConfig{}, RegistrationConfig{});
  map.restore(std::move(content), MapUse::kExtend);
  return map;
}

/// Whether the view of the next keyframe is kept.
bool keeps_next(GlobalMap& map) {
  map.add(record_at(static_cast<int>(map.records().size())));
  return !map.records().back().is_pose_only();
}

TEST(KeptViews, SixVisitsAreEnoughWhereNoLoopRecognizesThePlace) {
  GlobalMap after_five = map_of_laps(5, true);
  EXPECT_TRUE(keeps_next(after_five));
  GlobalMap after_six = map_of_laps(6, true);
  EXPECT_FALSE(keeps_next(after_six));
}

TEST(KeptViews, AllAreKeptWithoutALoopThatTellsThePlace) {
  GlobalMap map = map_of_laps(7, false);
  EXPECT_TRUE(keeps_next(map));
}

TEST(KeptViews, ALoopTellsThePlaceForTwentyMeters) {
  GlobalMap map = map_of_laps(6, true);
  const double step = 2.0 * std::sin(std::numbers::pi / kPerLap);
  const int known = static_cast<int>(20.0 / step);
  for (int i = 0; i < known; ++i) EXPECT_FALSE(keeps_next(map)) << i;
  for (int i = 0; i < kPerLap; ++i) keeps_next(map);
  EXPECT_TRUE(keeps_next(map));
}

}  // namespace
}  // namespace mms
