// Loop closure with simulated frames: the sensor comes back to places that it has seen, with poses
// that drifted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "mms/geometry/se3.hpp"
#include "mms/global_map/global_map.hpp"
#include "mms/pipeline/perception.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {
namespace {

/// An aisle with people, seen at 2 Hz.
SceneConfig aisle(int seed) {
  SceneConfig config = scene_config("rack_aisle");
  config.width = 320;
  config.hz = 2.0;
  config.seed = seed;
  return config;
}

constexpr int kSteps = 20;  // frames from one end of the path to the other

/// Perceived frames, with the true masks.
std::vector<GlobalKeyframe> views_of(int seed) {
  SimulatedScene scene(aisle(seed));
  SystemConfig config;
  config.fusion.stride = 1;  // the images are half the usual size
  Perception perception(config, std::make_unique<MaskSegmenter>());
  std::vector<GlobalKeyframe> views;
  for (int i = 0; i < kSteps; ++i) {
    const SimulatedFrame simulated = scene.render(i);
    const PerceivedFrame perceived =
        perception.perceive(simulated.frame, perception.segment(simulated.frame));
    views.push_back({simulated.frame.color, perceived.cloud, scene.truth(i).T_world_sensor, false});
  }
  return views;
}

const std::vector<GlobalKeyframe>& views() {
  static const std::vector<GlobalKeyframe> kViews = views_of(1);
  return kViews;
}

GlobalMap make_map() {
  GlobalMapConfig config;
  config.min_path = 2.0;
  const SystemConfig system;
  return GlobalMap(config, system.features, system.odometry.registration);
}

/// The path forward and backward; the poses of the way back drift.
struct Visit {
  GlobalMap map = make_map();
  std::vector<Eigen::Isometry3d> truth;  // by keyframe
  std::vector<Eigen::Isometry3d> drifted;

  void add(GlobalKeyframe keyframe, const Eigen::Isometry3d& drift) {
    truth.push_back(keyframe.T_world_sensor.isometry());
    const Eigen::Isometry3d pose = drift * truth.back();
    drifted.push_back(pose);
    keyframe.T_world_sensor = Transform<World, Sensor>(pose);
    keyframe.cloud.stamp = Timestamp(static_cast<std::int64_t>(truth.size()) * 1'000'000'000);
    map.add(keyframe);
  }

  double largest_error(const std::vector<Eigen::Isometry3d>& poses) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      largest = std::max(largest, (poses[i].translation() - truth[i].translation()).norm());
    }
    return largest;
  }
};

/// @param drift  of the second visit per step [m] to the right
Visit there_and_back(double drift) {
  Visit visit;
  for (int i = 0; i < kSteps; ++i) {
    visit.add(views()[static_cast<std::size_t>(i)], Eigen::Isometry3d::Identity());
  }
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  for (int i = kSteps - 1; i >= 0; --i) {
    offset.translation().x() += drift;
    visit.add(views()[static_cast<std::size_t>(i)], offset);
  }
  return visit;
}

/// Largest distance of the poses of both visits of a place, where loops can close [m].
double largest_gap(const std::vector<Eigen::Isometry3d>& poses) {
  double largest = 0.0;
  for (std::size_t i = 0; i + 4 < kSteps; ++i) {
    const Eigen::Vector3d back = poses[2 * kSteps - 1 - i].translation();
    largest = std::max(largest, (back - poses[i].translation()).norm());
  }
  return largest;
}

int accepted(const GlobalMap& map) {
  return static_cast<int>(std::count_if(map.loops().begin(), map.loops().end(), [](const Loop& l) {
    return l.outcome == LoopOutcome::kAccepted;
  }));
}

TEST(LoopClosing, CorrectsDriftOfASecondVisit) {
  const Visit visit = there_and_back(0.005);
  ASSERT_GT(largest_gap(visit.drifted), 0.09);
  EXPECT_GE(accepted(visit.map), kSteps / 2);
  EXPECT_LT(largest_gap(visit.map.poses()), 0.25 * largest_gap(visit.drifted));
  EXPECT_LT(visit.largest_error(visit.map.poses()), 0.5 * visit.largest_error(visit.drifted));
  EXPECT_FALSE(visit.map.correction().empty());
}

TEST(LoopClosing, EveryAcceptedLoopIsRight) {
  const Visit visit = there_and_back(0.005);
  for (const Loop& loop : visit.map.loops()) {
    if (loop.outcome != LoopOutcome::kAccepted) continue;
    const Eigen::Isometry3d truth = visit.truth[loop.candidate].inverse() * visit.truth[loop.query];
    const Eigen::Isometry3d error = truth.inverse() * loop.T_candidate_query;
    EXPECT_LT(error.translation().norm(), 0.05);
    EXPECT_LT(se3::angle(error), 0.01);
  }
}

TEST(LoopClosing, FindsAPlaceByItsLooksAfterBeingLost) {
  Visit visit;
  for (int i = 0; i < kSteps; ++i) {
    visit.add(views()[static_cast<std::size_t>(i)], Eigen::Isometry3d::Identity());
  }
  // Carried back in the dark: the pose is two meters off.
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  offset.translation() = Eigen::Vector3d(0.5, 0.0, 2.0);
  for (int i = 2; i < 8; ++i) {
    GlobalKeyframe keyframe = views()[static_cast<std::size_t>(i)];
    keyframe.after_lost = i == 2;
    visit.add(keyframe, offset);
  }
  ASSERT_GT(visit.largest_error(visit.drifted), 2.0);
  EXPECT_GE(accepted(visit.map), 2);
  EXPECT_LT(visit.largest_error(visit.map.poses()), 0.03);
}

TEST(LoopClosing, OtherPlacesThatLookAlikeCloseNoLoop) {
  Visit visit;
  for (const GlobalKeyframe& view : views()) visit.add(view, Eigen::Isometry3d::Identity());
  // Another aisle of the same racks: by odometry, it may be anywhere.
  bool after_lost = true;
  for (GlobalKeyframe view : views_of(2)) {
    view.after_lost = std::exchange(after_lost, false);
    visit.add(view, Eigen::Isometry3d::Identity());
  }
  EXPECT_EQ(accepted(visit.map), 0);
  EXPECT_TRUE(visit.map.correction().empty());
}

TEST(LoopClosing, EqualKeyframesGiveEqualPoses) {
  const Visit a = there_and_back(0.005);
  const Visit b = there_and_back(0.005);
  ASSERT_EQ(a.map.poses().size(), b.map.poses().size());
  for (std::size_t i = 0; i < a.map.poses().size(); ++i) {
    EXPECT_EQ(a.map.poses()[i].matrix(), b.map.poses()[i].matrix());
  }
}

TEST(LoopClosing, WithoutImagesDepthAloneCloses) {
  Visit visit;
  const auto without_image = [&](int i) {
    GlobalKeyframe keyframe = views()[static_cast<std::size_t>(i)];
    keyframe.color = {};
    return keyframe;
  };
  for (int i = 0; i < kSteps; ++i) visit.add(without_image(i), Eigen::Isometry3d::Identity());
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  offset.translation().x() = 0.05;
  for (int i = kSteps - 1; i >= 0; --i) visit.add(without_image(i), offset);
  EXPECT_GE(accepted(visit.map), kSteps / 2);
}

}  // namespace
}  // namespace mms
