#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "mms/geometry/se3.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {
namespace {

constexpr int kFrames = 30;
/// From here on there are views of the places where people come.
constexpr int kSettled = 10;

/// A warehouse in which a LiDAR that turns ten times a second drives among walkers and vehicles.
SceneConfig scan_config() {
  SceneConfig config = scene_config("warehouse_loop");
  const auto names = sensor_names();
  config.sensor =
      static_cast<int>(std::find(names.begin(), names.end(), "lidar16") - names.begin());
  config.hz = 10.0;
  config.width = 64;
  config.pause_share = 0.0;
  return config;
}

struct PlayedScan {
  double position_error = 0.0;       ///< worst, both begin at the origin [m]
  std::vector<double> point_errors;  ///< of static points in the world frame [m]
  std::size_t moving = 0;            ///< points of what moves
  std::size_t moving_found = 0;
  std::size_t still = 0;
  std::size_t still_taken = 0;  ///< for moving
};

void compare(const FrameResult& result, const SimulatedFrame& truth, PlayedScan& played) {
  const LabeledCloud& cloud = result.cloud;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] == PointLabel::kInvalid) continue;
    const bool is_dynamic = cloud.labels[i] == PointLabel::kDynamic;
    const int label = truth.scan.labels[i];
    if (label == 0) {
      ++played.still;
      played.still_taken += is_dynamic;
      const Eigen::Vector3d there = result.odometry.T_world_sensor * cloud.points[i].cast<double>();
      played.point_errors.push_back((there - truth.scan.points[i].cast<double>()).norm());
    } else if (truth.objects[static_cast<std::size_t>(label) - 1].moving) {
      ++played.moving;
      played.moving_found += is_dynamic;
    }
  }
}

PlayedScan play() {
  SimulatedScene scene(scan_config());
  SlamSystem system({}, std::make_unique<NoneSegmenter>());
  PlayedScan played;
  for (int i = 0; i < kFrames; ++i) {
    const SimulatedFrame truth = scene.render(i);
    const FrameResult result = system.process(truth.frame);
    const double error =
        (result.odometry.T_world_sensor.translation() - scene.truth(i).T_world_sensor.translation())
            .norm();
    played.position_error = std::max(played.position_error, error);
    if (i >= kSettled) compare(result, truth, played);
  }
  return played;
}

/// [rad/s]
double turn_rate(const SimulatedScene& scene, int frame) {
  return 10.0 * se3::angle((scene.truth(frame).T_world_sensor.inverse() *
                            scene.truth(frame + 1).T_world_sensor)
                               .isometry());
}

const PlayedScan& played() {
  static const PlayedScan the_played = play();
  return the_played;
}

double share(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

TEST(ScanSystem, TracksADriveAmongPeopleAndVehicles) {
  EXPECT_LT(played().position_error, 0.05);
}

TEST(ScanSystem, DeskewsThePointsOfAScan) {
  std::vector<double> errors = played().point_errors;
  ASSERT_GT(errors.size(), 100'000U);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.045);
  EXPECT_LT(errors[errors.size() * 9 / 10], 0.08);
}

/// The robot turns at a corner: within 0.5 s, it is four times as fast as expected.
TEST(ScanSystem, FollowsATurnThatBeginsSuddenly) {
  constexpr int kFirst = 500;
  SimulatedScene scene(scan_config());
  SlamSystem system({}, std::make_unique<NoneSegmenter>());
  const Eigen::Isometry3d T_first_truth = scene.truth(kFirst).T_world_sensor.isometry().inverse();
  double fastest = 0.0;
  for (int i = kFirst; i < kFirst + 16; ++i) {
    const FrameResult result = system.process(scene.render(i).frame);
    const Eigen::Isometry3d truth = T_first_truth * scene.truth(i).T_world_sensor.isometry();
    const Eigen::Isometry3d error = truth.inverse() * result.odometry.T_world_sensor.isometry();
    EXPECT_NE(result.odometry.status, Status::kLost) << i;
    EXPECT_LT(error.translation().norm(), 0.08) << i;
    EXPECT_LT(se3::angle(error), 0.01) << i;
    fastest = std::max(fastest, turn_rate(scene, i));
  }
  EXPECT_GT(fastest, 1.0);
}

TEST(ScanSystem, FindsMovingObjectsWithoutMasks) {
  ASSERT_GT(played().moving, 1000U);
  EXPECT_GT(share(played().moving_found, played().moving), 0.35);
  EXPECT_LT(share(played().still_taken, played().still), 0.001);
}

}  // namespace
}  // namespace mms
