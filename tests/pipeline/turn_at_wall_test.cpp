// A robot begins to turn in front of a wall, where the pixels of a few stripes alone show how it
// moves along the wall, and the last velocity predicts a wrong pose.
#include <gtest/gtest.h>

#include <memory>

#include "mms/geometry/se3.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {
namespace {

struct Part {
  int seed;
  int first;  ///< frame
};

class TurnAtWall : public ::testing::TestWithParam<Part> {};
// With the first part, the error of a frame was 23 cm before, with the second one 4 cm.
INSTANTIATE_TEST_SUITE_P(LongAisles, TurnAtWall, ::testing::Values(Part{4, 580}, Part{3, 2737}),
                         [](const auto& part) { return "seed" + std::to_string(part.param.seed); });

TEST_P(TurnAtWall, EachMotionIsRightToACentimeter) {
  constexpr int kFrames = 24;
  SceneConfig config = scene_config("long_aisles");
  config.seed = GetParam().seed;
  SimulatedScene scene(config);
  SlamSystem system(SystemConfig{}, std::make_unique<MaskSegmenter>());
  Eigen::Isometry3d last_truth, last_pose;
  for (int i = 0; i < kFrames; ++i) {
    const SimulatedFrame simulated = scene.render(GetParam().first + i);
    const FrameResult result = system.process(simulated.frame);
    const Eigen::Isometry3d truth = scene.pose_at(simulated.frame.stamp).T_world_sensor.isometry();
    const Eigen::Isometry3d pose = result.odometry.T_world_sensor.isometry();
    if (i > 0) {
      const Eigen::Isometry3d error =
          (last_truth.inverse() * truth).inverse() * (last_pose.inverse() * pose);
      EXPECT_LT(error.translation().norm(), 0.01) << "frame " << i;
      EXPECT_LT(se3::angle(error), 0.01) << "frame " << i;
    }
    last_truth = truth;
    last_pose = pose;
  }
}

}  // namespace
}  // namespace mms
