#include "mms/fusion/clouds/depth_cloud.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/geometry/camera.hpp"
#include "tests/fusion/scene.hpp"

namespace mms {
namespace {

using testing::render;
using testing::room;
using testing::View;

TEST(DepthCloud, PointsProjectToBlockCenter) {
  const View view = render(room());
  const LabeledCloud cloud = DepthCloudBuilder(FusionConfig{}).build(view.frame);
  ASSERT_EQ(cloud.width, 320);
  ASSERT_EQ(cloud.height, 240);
  const CameraModel full(*view.frame.calibration->camera);
  const auto i = static_cast<std::size_t>(50 * cloud.width + 70);
  const Eigen::Vector2d pixel = full.project(cloud.points[i].cast<double>());
  EXPECT_NEAR(pixel.x(), 140.5, 1e-3);
  EXPECT_NEAR(pixel.y(), 100.5, 1e-3);
  EXPECT_NEAR(cloud.points[i].z(), 4.0F, 1e-4F);
  EXPECT_EQ(cloud.colors[i], (Rgb{100, 110, 120}));
}

TEST(DepthCloud, BlockAcrossDepthStepKeepsNearSurface) {
  View view = render(room());
  view.frame.depth(200, 100) = 2.0F;
  view.frame.depth(201, 100) = 2.01F;
  const LabeledCloud cloud = DepthCloudBuilder(FusionConfig{}).build(view.frame);
  EXPECT_NEAR(cloud.points[50 * 320 + 100].z(), 2.005F, 1e-5F);
}

TEST(DepthCloud, DepthOutOfRangeIsNoReturn) {
  View view = render(room());
  for (auto& z : view.frame.depth.pixels()) z = 0.1F;
  FusionConfig config;
  EXPECT_EQ(DepthCloudBuilder(config).build(view.frame).labels[1000], PointLabel::kInvalid);
  for (auto& z : view.frame.depth.pixels()) z = 11.0F;
  EXPECT_EQ(DepthCloudBuilder(config).build(view.frame).labels[1000], PointLabel::kInvalid);
  for (auto& z : view.frame.depth.pixels()) z = 10.0F;
  EXPECT_EQ(DepthCloudBuilder(config).build(view.frame).labels[1000], PointLabel::kStatic);
}

TEST(DepthCloud, StrideFollowsTheSizeOfTheImagesUnlessItIsGiven) {
  const auto stride_for = [](int width, int height, int given = 0) {
    FusionConfig config;
    config.stride = given;
    CameraIntrinsics camera;
    camera.width = width;
    camera.height = height;
    return config.stride_of(camera);
  };
  EXPECT_EQ(stride_for(160, 120), 1);
  EXPECT_EQ(stride_for(320, 240), 1);
  EXPECT_EQ(stride_for(424, 240), 1);
  EXPECT_EQ(stride_for(512, 424), 2);
  EXPECT_EQ(stride_for(640, 480), 2);
  EXPECT_EQ(stride_for(848, 480), 2);
  EXPECT_EQ(stride_for(1280, 720), 3);
  EXPECT_EQ(stride_for(1920, 1080), 5);
  EXPECT_EQ(stride_for(1920, 1080, 2), 2);
  EXPECT_GT(stride_for(100000, 100000), 300) << "more pixels than an int counts";
}

TEST(DepthCloud, AnyStrideGivesSameWall) {
  const View view = render(room());
  for (const int stride : {1, 3, 4}) {
    FusionConfig config;
    config.stride = stride;
    const LabeledCloud cloud = DepthCloudBuilder(config).build(view.frame);
    EXPECT_EQ(cloud.width, 640 / stride);
    EXPECT_EQ(cloud.height, 480 / stride);
    EXPECT_NEAR(cloud.points[0].z(), 4.0F, 1e-4F);
  }
}

TEST(DepthCloud, RejectsColorOfOtherSize) {
  View view = render(room());
  view.frame.color = Image<Rgb>(320, 240);
  EXPECT_THROW(DepthCloudBuilder(FusionConfig{}).build(view.frame), DataError);
}

}  // namespace
}  // namespace mms
