#include "mms/localization/photometric/reference_keyframes.hpp"

#include <gtest/gtest.h>

#include "mms/localization/features/intensity_pyramid.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::motion;

std::vector<IntensityLevel> levels() {
  return build_intensity_pyramid(
      testing::organised_cloud(testing::BoxRoom{}, Eigen::Isometry3d::Identity()), 2);
}

Eigen::Isometry3d at(double x) {
  return motion(x, 0, 0, 0, 0, 0);
}

TEST(ReferenceKeyframes, NewKeyframeNeedsTranslationOrRotation) {
  PhotometricConfig config;
  config.keyframe_translation = 0.1;
  config.keyframe_parallax = 0.0;
  config.keyframe_rotation = 5.0;
  ReferenceKeyframes keyframes(config, {});
  keyframes.update(levels(), at(0.0));
  keyframes.update(levels(), at(0.09));
  EXPECT_EQ(keyframes.size(), 1U);
  keyframes.update(levels(), at(0.11));
  EXPECT_EQ(keyframes.size(), 2U);
  keyframes.update(levels(), motion(0, 0, 0, 0, 4.9 * M_PI / 180.0, 0));
  EXPECT_EQ(keyframes.size(), 2U);
  keyframes.update(levels(), motion(0, 0, 0, 0, 5.1 * M_PI / 180.0, 0));
  EXPECT_EQ(keyframes.size(), 3U);
}

TEST(ReferenceKeyframes, NewKeyframeDistanceScalesWithDepth) {
  PhotometricConfig config;
  config.keyframe_translation = 0.01;
  config.keyframe_parallax = 0.1;
  ReferenceKeyframes keyframes(config, {});
  keyframes.update(levels(), at(0.0));
  const double depth = keyframes.nearest(at(0.0)).front()->depth;
  ASSERT_GT(depth, 0.5);
  keyframes.update(levels(), at(0.09 * depth));
  EXPECT_EQ(keyframes.size(), 1U);
  keyframes.update(levels(), at(0.11 * depth));
  EXPECT_EQ(keyframes.size(), 2U);
}

TEST(ReferenceKeyframes, NearestComeFirstWithTheirPoses) {
  PhotometricConfig config;
  config.references = 2;
  ReferenceKeyframes keyframes(config, {});
  for (const double x : {0.0, 1.0, 2.0, 3.0}) keyframes.update(levels(), at(x));
  const auto nearest = keyframes.nearest(at(1.9));
  ASSERT_EQ(nearest.size(), 2U);
  EXPECT_TRUE(nearest[0]->T_world_sensor.isApprox(at(2.0)));
  EXPECT_TRUE(nearest[1]->T_world_sensor.isApprox(at(1.0)));
  EXPECT_EQ(nearest[0]->levels.size(), 2U);
}

TEST(ReferenceKeyframes, RemovesFarthestFirst) {
  PhotometricConfig config;
  config.max_keyframes = 3;
  config.references = 8;
  ReferenceKeyframes keyframes(config, {});
  for (const double x : {2.0, 1.0, 0.0, 4.0}) keyframes.update(levels(), at(x));
  EXPECT_EQ(keyframes.size(), 3U);
  for (const auto* keyframe : keyframes.nearest(at(0.0))) {
    EXPECT_GT(keyframe->T_world_sensor.translation().x(), 0.5);
  }
}

TEST(ReferenceKeyframes, EmptyWithoutImageOrWhenDisabled) {
  ReferenceKeyframes keyframes({}, {});
  keyframes.update({}, at(0.0));
  EXPECT_EQ(keyframes.size(), 0U);
  PhotometricConfig off;
  off.enabled = false;
  ReferenceKeyframes disabled(off, {});
  disabled.update(levels(), at(0.0));
  EXPECT_EQ(disabled.size(), 0U);
  EXPECT_TRUE(disabled.nearest(at(0.0)).empty());
}

}  // namespace
}  // namespace mms
