// A camera that drives through the warehouse sees a part of its robot.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {
namespace {

constexpr int kFrames = 50;

/// A bar from below, fixed to the camera.
void add_arm(Frame& frame) {
  for (int y = frame.depth.height() / 2; y < frame.depth.height(); ++y) {
    for (int x = 0; x < frame.depth.width(); ++x) {
      if (std::abs(x - frame.depth.width() / 2) > frame.depth.width() / 10) continue;
      frame.depth(x, y) = 0.7F - 0.001F * static_cast<float>(y);
      const auto grey = static_cast<std::uint8_t>((x / 12 + y / 12) % 2 == 0 ? 60 : 170);
      frame.color(x, y) = {grey, grey, grey};
      if (!frame.mask.empty()) frame.mask(x, y) = 0;
    }
  }
}

struct Drive {
  double error = 0.0;  ///< of the last position [m]
  int warnings = 0;    ///< about the robot
};

Drive drive(bool ignores, bool has_arm) {
  SceneConfig scene_settings = scene_config("warehouse_loop");
  scene_settings.width = 320;
  scene_settings.speed = 1.0;
  SimulatedScene scene(scene_settings);
  SystemConfig config;
  config.robot_body.enabled = ignores;
  SlamSystem system(config, std::make_unique<MaskSegmenter>());
  Drive drive;
  for (int i = 0; i < kFrames; ++i) {
    SimulatedFrame simulated = scene.render(i);
    if (has_arm) add_arm(simulated.frame);
    const FrameResult result = system.process(simulated.frame);
    for (const std::string& warning : result.warnings) {
      drive.warnings += warning.find("the robot itself") != std::string::npos;
    }
    const Eigen::Vector3d truth = scene.truth(i).T_world_sensor.translation();
    drive.error = (result.odometry.T_world_sensor.translation() - truth).norm();
  }
  return drive;
}

TEST(RobotBody, InTheViewDoesNotHoldThePose) {
  EXPECT_GT(drive(false, true).error, 1.0) << "else this shows nothing";
  const Drive ignoring = drive(true, true);
  EXPECT_LT(ignoring.error, 0.1);
  EXPECT_GE(ignoring.warnings, 1);
}

TEST(RobotBody, IsNotFoundWhereThereIsNone) {
  const Drive searching = drive(true, false);
  EXPECT_EQ(searching.error, drive(false, false).error);
  EXPECT_EQ(searching.warnings, 0);
}

}  // namespace
}  // namespace mms
