// Masks of people where there is nobody, and right ones that cover nearly all: the pose is not
// disturbed, and the map stays free of people.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "mms/pipeline/slam_system.hpp"
#include "tests/pipeline/played_scene.hpp"

namespace mms {
namespace {

using testing::mask_system;
using testing::scene;
using testing::scene_frame;

/// The true masks, and in `frames` of them a false one of `share` of the image's width.
class FalseMasks final : public Segmenter {
 public:
  FalseMasks(std::size_t begin, std::size_t end, double share)
      : begin_(begin), end_(end), share_(share) {}

  Segmentation segment(const Frame& frame) override {
    Segmentation result = truth_.segment(frame);
    const bool is_false = count_ >= begin_ && count_ < end_;
    ++count_;
    if (!is_false) return result;
    Instance& wrong = result.instances.emplace_back();
    wrong.score = 0.25F;
    wrong.mask = Image<std::uint8_t>(static_cast<int>(share_ * result.width), result.height, 1);
    wrong.x = (result.width - wrong.mask.width()) / 2;
    return result;
  }

 private:
  MaskSegmenter truth_;
  std::size_t begin_, end_;
  double share_;
  std::size_t count_ = 0;
};

SlamSystem system_with(std::size_t begin, std::size_t end, double share, bool checked = true) {
  SystemConfig config;
  config.mask_check.enabled = checked;
  return SlamSystem(config, std::make_unique<FalseMasks>(begin, end, share));
}

/// Largest error of the position in the scene's first frames [m]; large if one of them is lost.
double largest_error(SlamSystem system, std::size_t frames) {
  double largest = 0.0;
  for (std::size_t i = 0; i < frames; ++i) {
    const FrameResult result = system.process(scene_frame(i));
    if (result.odometry.status == Status::kLost) return 1e9;
    const Eigen::Vector3d truth = scene().truth(static_cast<int>(i)).T_world_sensor.translation();
    largest = std::max(largest, (result.odometry.T_world_sensor.translation() - truth).norm());
  }
  return largest;
}

TEST(FalseMasks, InTheMiddleDoNotDisturbThePose) {
  EXPECT_LT(largest_error(system_with(5, 15, 0.9), 20), 0.015);
  EXPECT_GT(largest_error(system_with(5, 15, 0.9, false), 20), 0.03);
}

TEST(FalseMasks, InTheFirstFramesDoNotDisturbThePose) {
  EXPECT_LT(largest_error(system_with(0, 5, 0.6), 12), 0.015);
}

TEST(FalseMasks, OfEverythingFromTheFirstFrameOnDoNotCauseLost) {
  EXPECT_LT(largest_error(system_with(0, 20, 1.0), 20), 0.03);
}

/// Three people walk close ahead of a driving camera from its first frame on: nearly all that it
/// sees moves with it.
TEST(RightMasks, OfPeopleWhoWalkAheadFromTheFirstFrameOnAreFollowed) {
  SceneConfig config = scene_config("warehouse_loop");
  config.companions = 3;
  config.seed = 1002;
  config.width = 320;
  SimulatedScene walked(config);
  SlamSystem system = mask_system();
  const auto error_at = [&](int i) {
    const FrameResult result = system.process(walked.render(i).frame);
    EXPECT_TRUE(i > 0 || result.overruled_share > 0.6) << "an easier start";
    EXPECT_NE(result.odometry.status, Status::kLost);
    return (result.odometry.T_world_sensor.translation() -
            walked.truth(i).T_world_sensor.translation())
        .norm();
  };
  double largest = 0.0;
  for (int i = 0; i < 6; ++i) largest = std::max(largest, error_at(i));
  EXPECT_LT(largest, 0.2) << "until both hypotheses differ";
  largest = 0.0;
  for (int i = 6; i < 20; ++i) largest = std::max(largest, error_at(i));
  EXPECT_LT(largest, 0.03);
}

TEST(FalseMasks, AreMarkedAsOverruled) {
  SlamSystem system = system_with(5, 6, 0.5);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_TRUE(system.process(scene_frame(i)).cloud.overruled.empty());
  }
  const LabeledCloud cloud = system.process(scene_frame(5)).cloud;
  ASSERT_FALSE(cloud.overruled.empty());
  for (std::size_t i = 0; i < cloud.overruled.size(); ++i) {
    EXPECT_TRUE(cloud.overruled[i] == 0 || cloud.labels[i] == PointLabel::kDynamic);
  }
}

TEST(FalseMasks, MakeNoTracks) {
  SlamSystem with = system_with(5, 15, 0.3);
  SlamSystem without = system_with(0, 0, 0.3);
  for (std::size_t i = 0; i < 20; ++i) {
    with.process(scene_frame(i));
    without.process(scene_frame(i));
  }
  EXPECT_EQ(with.dynamic_map().confirmed(), without.dynamic_map().confirmed());
}

TEST(FalseMasks, AreBelievedByTheBaselines) {
  SystemConfig config;
  config.fusion.mode = FusionMode::kVision;
  SlamSystem system(config, std::make_unique<FalseMasks>(3, 9, 0.5));
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_TRUE(system.process(scene_frame(i)).cloud.overruled.empty());
  }
}

}  // namespace
}  // namespace mms
