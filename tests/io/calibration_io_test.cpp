#include "mms/io/config/calibration_io.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/geometry/se3.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

const std::string kCamera =
    "fx: 500\nfy: 501\ncx: 320.5\ncy: 240\nwidth: 640\nheight: 480\ndepth_scale: 5000\n";

TEST(CalibrationIo, ReadsCamera) {
  const TempFolder folder;
  const Calibration calibration =
      read_calibration(folder.write("c.yaml", kCamera + "distortion: [0.1, -0.2, 0.01, 0.02]\n"));
  EXPECT_EQ(*calibration.camera,
            (CameraIntrinsics{500, 501, 320.5, 240, 640, 480, {0.1, -0.2, 0.01, 0.02, 0}}));
  EXPECT_EQ(calibration.depth_scale, 5000.0);
  EXPECT_TRUE(calibration.T_camera_lidar.isometry().matrix().isIdentity(0.0));
}

TEST(CalibrationIo, ReadsExtrinsicsFlatOrInRows) {
  const TempFolder folder;
  const auto z_of = [&](const std::string& yaml) {
    const Calibration calibration = read_calibration(folder.write("c.yaml", yaml));
    EXPECT_FALSE(calibration.camera);
    return calibration.T_camera_lidar.translation().z();
  };
  EXPECT_EQ(z_of("T_camera_lidar: [1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3]\n"), 3.0);
  EXPECT_EQ(z_of("T_camera_lidar:\n- [1, 0, 0, 1]\n- [0, 1, 0, 2]\n- [0, 0, 1, 3]\n"
                 "- [0, 0, 0, 1]\n"),
            3.0);
}

TEST(CalibrationIo, RoundTripsExactly) {
  const TempFolder folder;
  Calibration written;
  written.camera = CameraIntrinsics{517.3, 516.5, 318.6, 255.3, 640, 480, {0.2, -0.9, 0, 0, 1.1}};
  written.depth_scale = 999.7;
  written.max_depth = 9.1;
  Vector6d tangent;
  tangent << 0.1, -0.2, 1.0 / 3.0, 0.4, -0.5, 0.6;
  written.T_camera_lidar = Transform<Camera, Lidar>(se3::exp(tangent));
  written.depth_camera = DepthCamera{{421.6, 421.7, 423.8, 240.2, 848, 480, {}},
                                     Transform<Camera, Depth>(se3::exp(0.1 * tangent))};
  const auto path = folder.path() / "calibration.yaml";
  write_calibration(path, written);
  const Calibration read = read_calibration(path);
  EXPECT_EQ(read.camera, written.camera);
  EXPECT_EQ(read.depth_scale, written.depth_scale);
  EXPECT_EQ(read.max_depth, written.max_depth);
  EXPECT_EQ(read.T_camera_lidar.isometry().matrix(), written.T_camera_lidar.isometry().matrix());
  ASSERT_TRUE(read.depth_camera);
  EXPECT_EQ(read.depth_camera->camera, written.depth_camera->camera);
  EXPECT_EQ(read.depth_camera->T_color_depth.isometry().matrix(),
            written.depth_camera->T_color_depth.isometry().matrix());
}

TEST(CalibrationIo, ErrorsNameFileLineAndKey) {
  const TempFolder folder;
  const std::pair<std::string, const char*> cases[] = {
      {kCamera + "fz: 3\n", ":8: unknown key 'fz' (did you mean 'fx'?)"},
      {"fx: 500\nfy: 500\n", ": key 'cx' is missing (a camera needs"},
      {"depth_camera:\n  fx: 500\n", ": key 'fx' is missing"},
      {kCamera + "depth_camera:\n  fx: 500\n", ": depth_camera: key 'fy' is missing"},
      {kCamera + "depth_camera: 3\n", "depth_camera"},
      {"fx: 0\n" + kCamera.substr(8), ":1: fx is 0, allowed: 0.001 to 100000"},
      {"fx: -5\n" + kCamera.substr(8), ":1: fx is -5, allowed:"},
      {"fx: wide\n" + kCamera.substr(8), ":1: fx is 'wide', expected a number"},
      {"fx: .nan\n" + kCamera.substr(8), ":1: fx is '.nan', expected a number"},
      {kCamera + "distortion: [1, 2]\n", ":8: distortion is not a list of 4 or 5 numbers"},
      {kCamera + "distortion: [1, 2, 3, x]\n", ":8: distortion is 'x', expected a number"},
      {kCamera + "width: 640\n", ":8: width appears twice"},
      {kCamera + "max_depth: 0\n", ":8: max_depth is 0, allowed: 0.1 to 1000"},
      {"T_camera_lidar: 5\n", ":1: T_camera_lidar is '5', expected a matrix"},
      {"T_camera_lidar: [1, 2, 3]\n", ":1: T_camera_lidar is not a rigid transform"},
      {"T_camera_lidar: [1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0]\n", "is not a rotation"},
      {"T_camera_lidar: &a [*a]\n", "T_camera_lidar"},
      {"{{{{", "is not YAML"},
  };
  for (const auto& [yaml, expected] : cases) {
    const auto path = folder.write("c.yaml", yaml);
    const std::string message = message_of<ConfigError>([&] { read_calibration(path); });
    expect_in(path.string(), message);
    expect_in(expected, message);
  }
}

}  // namespace
}  // namespace mms
