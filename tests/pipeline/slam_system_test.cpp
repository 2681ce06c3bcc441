#include "mms/pipeline/slam_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mms/geometry/camera.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"
#include "tests/geometry/threads.hpp"
#include "tests/pipeline/played_scene.hpp"

namespace mms {
namespace {

using testing::mask_system;
using testing::scene;
using testing::scene_frame;
using testing::simulated_frame;

constexpr std::size_t kFrames = 40;

struct Played {
  double ate_rmse = 0.0;  ///< without alignment: both begin at the origin [m]
  MapCloud map;
  std::vector<FrameResult> results;
};

/// A frame with masks that fail as a network's do.
Frame with_imperfect_mask(const SimulatedFrame& simulated) {
  MaskErrorConfig errors;
  errors.enabled = true;
  std::vector<ObjectClass> classes;
  for (const ObjectTruth& object : simulated.objects) classes.push_back(object.object_class);
  Frame frame = simulated.frame;
  frame.mask =
      imperfect_masks(simulated.exact.object, classes, errors, 1, static_cast<int>(frame.index));
  return frame;
}

Played play(FusionMode mode, bool exact = true) {
  SlamSystem system = mask_system(mode);
  Played played;
  double squares = 0.0;
  for (std::size_t i = 0; i < kFrames; ++i) {
    const Frame frame = exact ? scene_frame(i) : with_imperfect_mask(simulated_frame(i));
    played.results.push_back(system.process(frame));
    const auto truth = scene().truth(static_cast<int>(frame.index)).T_world_sensor;
    const auto& estimate = played.results.back().odometry.T_world_sensor;
    squares += (estimate.translation() - truth.translation()).squaredNorm();
  }
  played.ate_rmse = std::sqrt(squares / static_cast<double>(kFrames));
  played.map = system.static_map().cloud();
  return played;
}

const Played& played(FusionMode mode) {
  static const Played multimodal = play(FusionMode::kMultimodal);
  static const Played none = play(FusionMode::kNone);
  return mode == FusionMode::kNone ? none : multimodal;
}

/// Share of ghost points: map points in the free space of the empty building, inside the
/// ground-truth box of a person at some frame.
double ghost_share(const MapCloud& map) {
  SceneConfig config = testing::played_config();
  config.crossing = config.leading = config.oncoming = config.working = config.agvs = 0;
  SimulatedScene empty(config);
  std::vector<char> ghost(map.size(), 0);
  for (int index = 0; index < static_cast<int>(kFrames); index += 4) {
    const SimulatedFrame truth = empty.render(index);
    const CameraModel camera(*truth.frame.calibration->camera);
    const auto T_sensor_world = scene().truth(index).T_world_sensor.inverse();
    const auto& objects = simulated_frame(static_cast<std::size_t>(index)).objects;
    for (std::size_t i = 0; i < map.size(); ++i) {
      const Eigen::Vector3d world = map.points[i].cast<double>();
      const bool inside = std::any_of(objects.begin(), objects.end(), [&](const auto& object) {
        const Eigen::Vector3d local = object.T_world_box.inverse() * world;
        return (local.cwiseAbs() - object.half_extent).maxCoeff() < 0.0;
      });
      const Eigen::Vector3d p = T_sensor_world * world;
      if (!inside || p.z() <= 0.1) continue;
      const Eigen::Vector2d pixel = camera.project(p);
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y()));
      if (!truth.exact.depth.contains(u, v)) continue;
      ghost[i] |= static_cast<double>(truth.exact.depth(u, v)) > p.z() + 0.15;
    }
  }
  return std::accumulate(ghost.begin(), ghost.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(1, map.size()));
}

TEST(SlamSystem, TracksTheCameraAmongPeople) {
  const Played& run = played(FusionMode::kMultimodal);
  RecordProperty("ate_rmse_mm", std::to_string(1e3 * run.ate_rmse));
  EXPECT_LT(run.ate_rmse, 0.008);
  EXPECT_EQ(run.results.front().odometry.status, Status::kInitialized);
  double most_dynamic = 0.0;
  for (std::size_t i = 1; i < run.results.size(); ++i) {
    EXPECT_EQ(run.results[i].odometry.status, Status::kTracking) << i;
    EXPECT_EQ(run.results[i].odometry.stamp, scene_frame(i).stamp);
    most_dynamic = std::max(most_dynamic, run.results[i].dynamic_share);
  }
  EXPECT_GT(most_dynamic, 0.2);
}

/// Up to 6 degrees from frame to frame, in changing directions: the last velocity misleads.
TEST(SlamSystem, TracksFastTurnsAtALowFrameRate) {
  SceneConfig config = scene_config("static");
  config.trajectory = CameraTrajectory::kShaken;
  config.hz = 5.0;
  config.width = 320;
  config.seed = 2;
  config.turn_rate = 30.0;
  SimulatedScene shaken(config);
  SystemConfig system_config;
  SlamSystem system(system_config, std::make_unique<NoneSegmenter>());
  for (int i = 0; i < 30; ++i) {
    const FrameResult result = system.process(shaken.render(i).frame);
    EXPECT_NE(result.odometry.status, Status::kLost) << i;
    const Eigen::Isometry3d error =
        (shaken.truth(i).T_world_sensor.inverse() * result.odometry.T_world_sensor).isometry();
    EXPECT_LT(error.translation().norm(), 0.2) << i;
  }
}

TEST(SlamSystem, TracksTheCameraWithFaultyMasks) {
  const Played imperfect = play(FusionMode::kMultimodal, false);
  const double exact = played(FusionMode::kMultimodal).ate_rmse;
  RecordProperty("ate_rmse_mm", std::to_string(1e3 * imperfect.ate_rmse));
  RecordProperty("ate_rmse_mm_exact", std::to_string(1e3 * exact));
  EXPECT_LT(imperfect.ate_rmse, 0.02);
  const double ghosts = ghost_share(imperfect.map);
  RecordProperty("ghost_percent", std::to_string(100.0 * ghosts));
  // Who had no mask yet in the first frames is in the map of so short a ride.
  EXPECT_LT(ghosts, 0.5 * ghost_share(played(FusionMode::kNone).map));
}

TEST(SlamSystem, FindsMovingPeopleWithoutMasks) {
  SceneConfig walker = scene_config("still_walker");
  walker.width = 320;
  SimulatedScene hall(walker);
  SystemConfig config;
  SlamSystem system(config, std::make_unique<NoneSegmenter>());
  std::size_t people = 0;
  std::size_t found = 0;
  std::size_t others = 0;
  std::size_t wrong = 0;
  for (int index = 0; index < 60; ++index) {
    const SimulatedFrame frame = hall.render(index);
    const FrameResult result = system.process(frame.frame);
    for (std::size_t i = 0; i < result.cloud.labels.size(); ++i) {
      if (result.cloud.labels[i] == PointLabel::kInvalid) continue;
      const bool dynamic = result.cloud.labels[i] == PointLabel::kDynamic;
      ++(frame.exact.object[i] != 0 ? people : others);
      if (dynamic) ++(frame.exact.object[i] != 0 ? found : wrong);
    }
  }
  const double recall = static_cast<double>(found) / static_cast<double>(people);
  const double false_share = static_cast<double>(wrong) / static_cast<double>(others);
  RecordProperty("people_percent", std::to_string(100.0 * recall));
  RecordProperty("false_percent", std::to_string(100.0 * false_share));
  EXPECT_GT(people, 10000U);
  EXPECT_GT(recall, 0.4);
  EXPECT_LT(false_share, 0.002);
}

TEST(SlamSystem, KeepsPeopleOutOfTheStaticMap) {
  const MapCloud& map = played(FusionMode::kMultimodal).map;
  EXPECT_GT(map.size(), 10000U);
  const double ghosts = ghost_share(map);
  const double without_filter = ghost_share(played(FusionMode::kNone).map);
  RecordProperty("ghost_percent", std::to_string(100.0 * ghosts));
  RecordProperty("ghost_percent_none", std::to_string(100.0 * without_filter));
  EXPECT_LT(ghosts, 0.004);
  EXPECT_GT(without_filter, 0.03);  // else the comparison means nothing
}

TEST(SlamSystem, KeepsPeopleInTheMapWithoutFilter) {
  const double none = played(FusionMode::kNone).ate_rmse;
  RecordProperty("ate_rmse_mm", std::to_string(1e3 * none));
  EXPECT_GT(none, 3.0 * played(FusionMode::kMultimodal).ate_rmse);
  for (const FrameResult& result : played(FusionMode::kNone).results) {
    EXPECT_EQ(result.dynamic_share, 0.0);
  }
}

TEST(SlamSystem, TracksPeopleAsObjects) {
  SlamSystem system = mask_system();
  std::vector<TrackedObject> tracked;
  for (int i = 0; i < 15; ++i) {
    tracked = system.process(scene_frame(static_cast<std::size_t>(i))).objects;
  }
  ASSERT_FALSE(tracked.empty());
  const auto& objects = simulated_frame(14).objects;
  std::size_t inside = 0;
  for (const TrackedObject& track : tracked) {
    double outside = std::numeric_limits<double>::infinity();  // the nearest true box [m]
    for (const ObjectTruth& object : objects) {
      if (object.object_class != track.box.object_class) continue;
      const Eigen::Vector3d local = object.T_world_box.inverse() * track.box.center();
      outside = std::min(outside, (local.cwiseAbs() - object.half_extent).maxCoeff());
    }
    EXPECT_LT(outside, 0.8);  // two who walk side by side may be one object
    inside += outside < 0.0 ? 1 : 0;
  }
  EXPECT_GT(2 * inside, tracked.size());
}

TEST(SlamSystem, ProcessEqualsItsStepsInOrder) {
  SlamSystem whole = mask_system();
  SlamSystem parts = mask_system();
  for (std::size_t i = 0; i < 5; ++i) {
    const FrameResult a = whole.process(scene_frame(i));
    const FrameResult b =
        parts.map(parts.localize(parts.perceive(scene_frame(i), parts.segment(scene_frame(i)))));
    EXPECT_TRUE(testing::same_bits(a, b)) << i;
  }
}

TEST(SlamSystem, GivesSameBitsForAnyNumberOfThreads) {
  const auto run = [&] {
    SlamSystem system = mask_system();
    std::vector<FrameResult> results;
    for (std::size_t i = 0; i < 10; ++i) results.push_back(system.process(scene_frame(i)));
    return std::pair(results, system.static_map().cloud().points);
  };
  const auto one = testing::on_threads(1, run);
  for (const int threads : {2, 4}) {
    const auto many = testing::on_threads(threads, run);
    for (std::size_t i = 0; i < 10; ++i) {
      EXPECT_TRUE(testing::same_bits(one.first[i], many.first[i])) << i;
    }
    EXPECT_EQ(one.second, many.second);
  }
}

}  // namespace
}  // namespace mms
