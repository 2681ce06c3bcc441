#include "mms/localization/photometric/image_shift.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "mms/geometry/camera.hpp"
#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Brightness of a far scene by direction, which repeats nowhere.
float brightness(const Eigen::Vector3d& direction) {
  const double yaw = std::atan2(direction.x(), direction.z());
  const double pitch = std::atan2(direction.y(), std::hypot(direction.x(), direction.z()));
  const double waves = std::sin(7.0 * yaw + 3.0 * pitch) +
                       std::sin(5.0 * pitch - 11.0 * yaw * yaw) + std::sin(9.0 * pitch + 2.0);
  return static_cast<float>(120.0 + 30.0 * waves);
}

/// The scene as a camera sees it that is turned.
IntensityLevel view(const Eigen::Matrix3d& R_world_camera) {
  IntensityLevel level;
  level.camera = {70.0, 70.0, 39.5, 29.5, 80, 60, {}};
  level.intensity = Image<IntensitySample>(80, 60);
  level.depth = Image<float>(80, 60, 2.0F);
  const CameraModel camera(level.camera);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x)
      level.intensity(x, y).value = brightness(R_world_camera * camera.ray({x, y}));
  }
  return level;
}

Eigen::Matrix3d turn(double yaw, double pitch) {
  return (Eigen::AngleAxisd(yaw * kDegree, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(pitch * kDegree, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// Angle between two rotations [degrees].
double angle(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle() / kDegree;
}

TEST(ImageShift, FindsTurnsBetweenImages) {
  for (const auto& [yaw, pitch] : {std::pair(0.0, 0.0), {8.0, 0.0}, {-12.0, 3.0}, {5.0, -9.0}}) {
    const Eigen::Matrix3d truth = turn(yaw, pitch);
    const auto found = rotations_by_shift(view(turn(0.0, 0.0)), view(truth), 3);
    ASSERT_FALSE(found.empty());
    EXPECT_LE(found.size(), 3U);
    EXPECT_LT(angle(found.front(), truth), 2.0) << yaw << " " << pitch;
  }
}

TEST(ImageShift, DynamicPixelsHaveNoInfluence) {
  const Eigen::Matrix3d truth = turn(8.0, 2.0);
  IntensityLevel now = view(truth);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 30; ++x) {
      now.intensity(x, y).value = x % 20 < 10 ? 250.0F : 0.0F;  // a person in stripes
      now.depth(x, y) = 0.0F;
    }
  }
  const auto found = rotations_by_shift(view(turn(0.0, 0.0)), now, 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(angle(found.front(), truth), 2.0);
}

TEST(ImageShift, ImagesWithoutContrastOrOfOtherSizeGiveNone) {
  const IntensityLevel before = view(turn(0.0, 0.0));
  IntensityLevel plain = before;
  for (IntensitySample& sample : plain.intensity.pixels()) sample.value = 100.0F;
  EXPECT_TRUE(rotations_by_shift(before, plain, 2).empty());
  IntensityLevel hidden = before;
  for (float& depth : hidden.depth.pixels()) depth = 0.0F;
  EXPECT_TRUE(rotations_by_shift(hidden, before, 2).empty());
  IntensityLevel smaller = before;
  smaller.intensity = Image<IntensitySample>(80, 40);
  smaller.depth = Image<float>(80, 40, 2.0F);
  EXPECT_TRUE(rotations_by_shift(before, smaller, 2).empty());
  EXPECT_TRUE(rotations_by_shift({}, {}, 2).empty());
}

}  // namespace
}  // namespace mms
