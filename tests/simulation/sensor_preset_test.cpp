#include "mms/simulation/sensors/sensor_preset.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <string_view>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/geometry/camera.hpp"

namespace mms {
namespace {

TEST(SensorPreset, AreListedInOrder) {
  const std::vector<std::string_view> expected{"l515",    "d435",    "kinect",
                                               "lidar16", "lidar64", "livox"};
  const auto names = sensor_names();
  EXPECT_EQ(std::vector(names.begin(), names.end()), expected);
  for (const std::string_view name : names) EXPECT_EQ(sensor_preset(name).name, name);
}

TEST(SensorPreset, ErrorListsKnownNames) {
  try {
    sensor_preset("l516");
    FAIL();
  } catch (const DataError& error) {
    EXPECT_STREQ(error.what(),
                 "sensor: 'l516' is none of l515, d435, kinect, lidar16, lidar64, livox (choose "
                 "one of them)");
  }
}

TEST(SensorPreset, HaveOneRangeSensorAndValidCamera) {
  for (const std::string_view name : sensor_names()) {
    const SensorPreset head = sensor_preset(name);
    EXPECT_NE(head.depth.has_value(), head.lidar.has_value()) << name;
    EXPECT_EQ(head.color.intrinsics.width, 640) << name;
    EXPECT_EQ(head.color.intrinsics.height, 480) << name;
    EXPECT_LT(head.color.exposure, 1.0 / head.hz) << name;
    const CameraModel camera(head.color.intrinsics);
    for (const double x : {-1.0, 320.0, 640.0}) {
      for (const double y : {-1.0, 240.0, 480.0}) {
        const Eigen::Vector3d ray = camera.ray({x, y});
        EXPECT_TRUE(camera.in_lens_range(ray)) << name;
        EXPECT_LT((camera.project(ray) - Eigen::Vector2d(x, y)).norm(), 1e-6) << name;
      }
    }
  }
}

TEST(SensorPreset, DepthFitsIntoSixteenBits) {
  for (const std::string_view name : {"l515", "d435", "kinect"}) {
    const SensorPreset head = sensor_preset(name);
    EXPECT_LT(head.depth->max_range * head.depth_scale, 65535.0) << name;
  }
}

TEST(SensorPreset, DepthNoiseEqualsPublished) {
  const DepthNoise l515 = sensor_preset("l515").depth->noise;
  EXPECT_NEAR(l515.sigma(1.0), 0.0025, 1e-5);
  EXPECT_NEAR(l515.sigma(9.0), 0.0155, 1e-5);
  const DepthNoise d435 = sensor_preset("d435").depth->noise;
  for (const double z : {1.0, 2.0, 4.0, 6.0, 10.0}) {
    const double published = z * z * 0.08 / (447.0 * 0.050);
    EXPECT_NEAR(d435.sigma(z), published, 0.12 * published) << z;
  }
  EXPECT_NEAR(sensor_preset("kinect").depth->noise.sigma(2.4), 0.0012 + 0.0019 * 4.0, 1e-9);
}

TEST(SensorPreset, LidarsAreAboveCameraAndParallel) {
  for (const std::string_view name : {"lidar16", "lidar64", "livox"}) {
    const SensorPreset head = sensor_preset(name);
    const Eigen::Isometry3d& T = head.T_camera_lidar;
    EXPECT_NEAR(T.translation().y(), -0.1, 1e-9) << name;
    EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12) << name;
    const double degrees = std::acos((T.linear() * Eigen::Vector3d::UnitX()).z()) * 57.29578;
    EXPECT_GT(degrees, 0.1) << name;
    EXPECT_LT(degrees, 1.0) << name;
    EXPECT_LT((T.linear() * Eigen::Vector3d::UnitZ()).y(), -0.999) << name;
    EXPECT_EQ(head.hz, 10.0) << name;
  }
  EXPECT_TRUE(sensor_preset("l515").T_camera_lidar.isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace mms
