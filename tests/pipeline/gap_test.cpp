// No frames arrive for some seconds.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {
namespace {

constexpr int kFirst = 90;  ///< frame; in warehouse_loop the camera drives at 0.9 m/s
constexpr int kBefore = 10;
constexpr int kMissing = 50;  ///< 3.4 s
constexpr int kAfter = 5;

struct Drive {
  std::vector<Status> after;  ///< of the frames after the gap
  double error = 0.0;         ///< of the way across the gap [m]
};

Drive drive(const std::string& scene_name, bool closes_loops) {
  SceneConfig scene_settings = scene_config(scene_name);
  scene_settings.seed = 201;
  SimulatedScene scene(scene_settings);
  SystemConfig config;
  config.global_map.enabled = closes_loops;
  SlamSystem system(config, std::make_unique<MaskSegmenter>());
  Drive drive;
  const Eigen::Isometry3d T_first = scene.truth(kFirst).T_world_sensor.isometry();
  for (int i = 0; i < kBefore + kAfter; ++i) {
    const int frame = kFirst + i + (i < kBefore ? 0 : kMissing);
    const FrameResult result = system.process(scene.render(frame).frame);
    if (i < kBefore) continue;
    drive.after.push_back(result.odometry.status);
    const Eigen::Isometry3d truth =
        T_first.inverse() * scene.truth(frame).T_world_sensor.isometry();
    const Eigen::Vector3d estimate = result.odometry.T_world_sensor.translation();
    drive.error = (estimate - truth.translation()).norm();
  }
  return drive;
}

TEST(Gap, OfSecondsMakesTheSensorLostWhereItsPoseLooksWrong) {
  const Drive misled = drive("warehouse_loop", false);
  EXPECT_EQ(misled.after, std::vector<Status>(kAfter, Status::kTracking));
  EXPECT_GT(misled.error, 1.0) << "else this shows nothing";
  EXPECT_EQ(drive("warehouse_loop", true).after, std::vector<Status>(kAfter, Status::kLost));
}

TEST(Gap, IsNoMotionByOdometryIfAnotherPlaceIsRecognizedAfterIt) {
  SceneConfig scene_settings = scene_config("warehouse_loop");
  scene_settings.seed = 201;
  SimulatedScene scene(scene_settings);
  SlamSystem system(SystemConfig{}, std::make_unique<MaskSegmenter>());
  for (int i = 0; i < kBefore; ++i) system.process(scene.render(kFirst + i).frame);
  const Frame frame = scene.render(kFirst + kBefore + kMissing).frame;
  FrameResult lost = system.localize(system.perceive(frame, system.segment(frame)));
  ASSERT_TRUE(lost.wants_relocalization);
  ASSERT_TRUE(lost.has_pose_in_doubt) << "else the frame is lost in any case";
  Relocalization place;
  place.T_world_sensor =
      Transform<World, Sensor>(Eigen::Isometry3d(Eigen::Translation3d(20.0, 0.0, 0.0)));
  const FrameResult found = system.relocate(std::move(lost), place);
  EXPECT_TRUE(found.relocalized);
  EXPECT_TRUE(found.global_keyframe);
  EXPECT_TRUE(found.after_lost) << "the pose graph would trust a motion of 20 m";
}

TEST(Gap, OfASensorAtRestIsBridged) {
  const Drive bridged = drive("still_walker", true);
  EXPECT_EQ(bridged.after, std::vector<Status>(kAfter, Status::kTracking));
  EXPECT_LT(bridged.error, 0.01);
}

}  // namespace
}  // namespace mms
