#include "mms/mapping/static_map/surface_points.hpp"

#include <gtest/gtest.h>

#include "mms/core/random_stream.hpp"
#include "tests/mapping/synthetic_cloud.hpp"

namespace mms {
namespace {

using test::organised_cloud;
using test::plane_cloud;
using test::pose;

TEST(SurfacePoints, KeepPlaneWithNormal) {
  const auto points = surface_points(plane_cloud({0, 0, 1}, 2.0, pose({0, 0, 0})), {});
  ASSERT_EQ(points.size(), 160U * 120U);
  const SurfacePoint& center = points[60 * 160 + 80];
  EXPECT_NEAR(center.normal.z(), -1.0F, 1e-4F);
  EXPECT_EQ(center.color, (Rgb{100, 150, 200}));
}

TEST(SurfacePoints, KeepFloorAtGrazingAngle) {
  const LabeledCloud cloud = organised_cloud([](int, int, const Eigen::Vector3f& ray) {
    const float z = 1.2F / ray.y();
    return z > 0.0F && z < 6.0F ? z : 0.0F;
  });
  const auto returns = std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kStatic);
  // Only the row next to the horizon, which has a single difference, may be dropped.
  EXPECT_GE(surface_points(cloud, {}).size(), static_cast<std::size_t>(returns - 160));
}

TEST(SurfacePoints, DropMixedPixelsBetweenSurfaces) {
  const LabeledCloud cloud = organised_cloud([](int x, int, const Eigen::Vector3f&) {
    return x < 80 ? 1.0F : x == 80 ? 2.0F : 3.0F;
  });
  for (const SurfacePoint& surface : surface_points(cloud, {})) {
    EXPECT_TRUE(surface.point.z() == 1.0F || surface.point.z() == 3.0F) << surface.point.z();
  }
}

TEST(SurfacePoints, KeepWallWithDropouts) {
  RandomStream random(1);
  const LabeledCloud cloud = organised_cloud(
      [&](int, int, const Eigen::Vector3f&) { return random.uniform() < 0.4 ? 0.0F : 2.0F; });
  const auto returns = std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kStatic);
  // A side of three is missing in 0.4^3, none of the four in 77 % of the cases.
  EXPECT_NEAR(static_cast<double>(surface_points(cloud, {}).size()),
              0.77 * static_cast<double>(returns), 0.03 * static_cast<double>(returns));
}

TEST(SurfacePoints, DropBoundaryOfHole) {
  const LabeledCloud cloud = organised_cloud(
      [](int x, int y, const Eigen::Vector3f&) { return x > 100 && y > 50 ? 0.0F : 2.0F; });
  const auto returns = std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kStatic);
  // One row and one column beside the hole, without the corner, whose sides are partly present.
  EXPECT_EQ(surface_points(cloud, {}).size(), static_cast<std::size_t>(returns - 57 - 67));
}

TEST(SurfacePoints, DropBoundaryOfDynamicPixels) {
  LabeledCloud cloud = plane_cloud({0, 0, 1}, 2.0, pose({0, 0, 0}));
  const std::size_t all = surface_points(cloud, {}).size();
  cloud.dynamic_pixels = Image<std::uint8_t>(cloud.width, cloud.height);
  EXPECT_EQ(surface_points(cloud, {}).size(), all);
  cloud.dynamic_pixels(80, 60) = 1;
  cloud.dynamic_pixels(0, 0) = 1;
  // 0.02 of 160 pixels are three: a square of 7 x 7 pixels, 4 x 4 of it in the corner.
  EXPECT_EQ(surface_points(cloud, {.boundary = 0.02}).size(), all - 49 - 16);
  EXPECT_EQ(surface_points(cloud, {.boundary = 0.0}).size(), all - 2);
}

TEST(SurfacePoints, DropFarDynamicAndInvalidPoints) {
  LabeledCloud cloud = organised_cloud([](int x, int, const Eigen::Vector3f&) {
    return x < 40 ? 0.0F : x < 80 ? 7.0F : 2.0F;
  });
  for (std::size_t i = 0; i < cloud.labels.size(); ++i) {
    if (i % 160 >= 120) cloud.labels[i] = PointLabel::kDynamic;
  }
  const auto points = surface_points(cloud, {});
  // Columns 80 to 119 are near and static; the depth step removes the first two.
  EXPECT_EQ(points.size(), 38U * 120U);
  for (const SurfacePoint& surface : points) EXPECT_EQ(surface.point.z(), 2.0F);
}

TEST(SurfacePoints, WeighNearPointsMore) {
  const auto near = surface_points(plane_cloud({0, 0, 1}, 1.0, pose({0, 0, 0})), {});
  const auto far = surface_points(plane_cloud({0, 0, 1}, 4.0, pose({0, 0, 0})), {});
  EXPECT_GT(near[9680].weight, 10.0F * far[9680].weight);
}

TEST(SurfacePoints, KeepFarPointsOfScans) {
  LabeledCloud scan;
  scan.height = 1;
  scan.points = {{50.0F, 0.0F, 0.0F}, {NAN, NAN, NAN}, {2000.0F, 0.0F, 0.0F}, {0.0F, -3.0F, 0.0F}};
  scan.labels = {PointLabel::kStatic, PointLabel::kInvalid, PointLabel::kStatic,
                 PointLabel::kDynamic};
  const auto points = surface_points(scan, {});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].point.x(), 50.0F);
  EXPECT_EQ(points[0].color, (Rgb{128, 128, 128}));
  const auto grey_of = [&](std::uint8_t intensity) {
    scan.intensity = {intensity, 0, 0, 0};
    return surface_points(scan, {})[0].color.g;
  };
  EXPECT_EQ(grey_of(0), 55);
  EXPECT_EQ(grey_of(64), 155);  // a quarter
  EXPECT_EQ(grey_of(255), 255);
  scan.colors.assign(4, {1, 2, 3});
  EXPECT_EQ(surface_points(scan, {})[0].color, (Rgb{1, 2, 3}));
}

TEST(IntensityGrey, IsInverted) {
  std::vector<Rgb> greys;
  for (int i = 0; i <= 255; ++i) greys.push_back(grey_of(static_cast<std::uint8_t>(i)));
  const std::vector<float> intensities = intensities_of(greys);
  ASSERT_EQ(intensities.size(), greys.size());
  // Half a grey of 200 moves the root by 1/400.
  for (int i = 0; i <= 255; ++i) {
    const float intensity = static_cast<float>(i) / 255.0F;
    EXPECT_NEAR(intensities[static_cast<std::size_t>(i)], intensity, 0.006F) << i;
  }
}

TEST(IntensityGrey, KnowsColorsOfCamerasAndMapsWithoutIntensity) {
  EXPECT_TRUE(intensities_of({grey_of(7), {200, 100, 100}}).empty());
  EXPECT_TRUE(intensities_of({grey_of(7), {20, 20, 20}}).empty());
  EXPECT_TRUE(intensities_of({kNoColor, kNoColor}).empty());
  EXPECT_TRUE(intensities_of({}).empty());
}

}  // namespace
}  // namespace mms
