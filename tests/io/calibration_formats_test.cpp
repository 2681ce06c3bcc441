#include "mms/io/config/calibration_formats.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

constexpr CameraIntrinsics kExpected{
    610.5, 611.5, 320.25, 240.75, 640, 480, {0.1, -0.2, 0.001, -0.002, 0.0}};

FormattedCalibration read(const std::string& text, const std::string& name = "camera.yaml") {
  const TempFolder folder;
  return read_any_calibration(folder.write(name, text));
}

TEST(CalibrationFormats, ReadsRos) {
  const auto read_ros = read(R"(image_width: 640
image_height: 480
camera_name: rgb
camera_matrix:
  rows: 3
  cols: 3
  data: [610.5, 0, 320.25, 0, 611.5, 240.75, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.1, -0.2, 0.001, -0.002, 0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
)");
  EXPECT_EQ(*read_ros.calibration.camera, kExpected);
  EXPECT_EQ(read_ros.format, "ROS or OpenCV");
  EXPECT_TRUE(read_ros.assumed_depth_scale);
  EXPECT_EQ(read_ros.calibration.depth_scale, 1000.0);
}

TEST(CalibrationFormats, ReadsOpenCv) {
  const auto calibration = read(R"(%YAML:1.0
---
calibration_time: "Mon 01 Jan 2024"
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 610.5, 0., 320.25, 0., 611.5, 240.75, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ 1.0e-01, -2.0e-01, 1.0e-03, -2.0e-03, 0. ]
)");
  EXPECT_EQ(*calibration.calibration.camera, kExpected);
}

TEST(CalibrationFormats, ReadsKalibr) {
  const auto calibration = read(R"(cam0:
  camera_model: pinhole
  distortion_coeffs: [0.1, -0.2, 0.001, -0.002]
  distortion_model: radtan
  intrinsics: [610.5, 611.5, 320.25, 240.75]
  resolution: [640, 480]
  rostopic: /cam0/image_raw
)");
  EXPECT_EQ(*calibration.calibration.camera, kExpected);
  EXPECT_EQ(calibration.format, "Kalibr");
}

TEST(CalibrationFormats, ReadsEuroc) {
  const auto calibration = read(R"(sensor_type: camera
T_BS:
  cols: 4
  rows: 4
  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
rate_hz: 20
resolution: [640, 480]
camera_model: pinhole
intrinsics: [610.5, 611.5, 320.25, 240.75] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [0.1, -0.2, 0.001, -0.002]
)");
  EXPECT_EQ(*calibration.calibration.camera, kExpected);
  EXPECT_EQ(calibration.format, "EuRoC");
}

TEST(CalibrationFormats, ReadsOrbSlam) {
  for (const std::string name : {"Camera", "Camera1"}) {
    const auto calibration =
        read("%YAML:1.0\n\n#------\nCamera.type: \"PinHole\"\n" + name + ".fx: 610.5\n" + name +
             ".fy: 611.5\n" + name + ".cx: 320.25\n" + name + ".cy: 240.75\n" + name +
             ".k1: 0.1\n" + name + ".k2: -0.2\n" + name + ".p1: 0.001\n" + name +
             ".p2: -0.002\nCamera.width: 640\nCamera.height: 480\n"
             "Camera.fps: 30.0\nRGBD.DepthMapFactor: 5000.0\n");
    EXPECT_EQ(*calibration.calibration.camera, kExpected) << name;
    EXPECT_EQ(calibration.calibration.depth_scale, 5000.0);
    EXPECT_FALSE(calibration.assumed_depth_scale);
  }
}

TEST(CalibrationFormats, ReadsOpen3dAndOwn) {
  const auto json = read(
      R"({"width": 640, "height": 480, "intrinsic_matrix":
          [610.5, 0, 0, 0, 611.5, 0, 320.25, 240.75, 1]})",
      "camera.json");
  EXPECT_EQ(json.calibration.camera->fy, 611.5);
  const auto own = read(
      "fx: 610.5\nfy: 611.5\ncx: 320.25\ncy: 240.75\nwidth: 640\nheight: 480\n"
      "depth_scale: 5000\ndistortion: [0.1, -0.2, 0.001, -0.002]\n");
  EXPECT_EQ(*own.calibration.camera, kExpected);
  EXPECT_EQ(own.format, "MMS-SLAM");
}

/// The message for a Kalibr file with another line in place of one of its own.
std::string fault_of(const std::string& line, const std::string& other) {
  std::string text =
      "cam0:\n  camera_model: pinhole\n  distortion_coeffs: [0.1, 0.2, 0.0, 0.0]\n"
      "  distortion_model: radtan\n  intrinsics: [610.5, 611.5, 320.25, 240.75]\n"
      "  resolution: [640, 480]\n";
  text.replace(text.find(line), line.size(), other);
  return message_of<ConfigError>([&] { read(text); });
}

TEST(CalibrationFormats, NamesWhatItCannotUse) {
  expect_in("camera.yaml:4: cam0.distortion_model is 'equidistant', which is not supported",
            fault_of("radtan", "equidistant"));
  expect_in("cam0.camera_model is 'omni', which is not supported", fault_of("pinhole", "omni"));
  expect_in("cam0.intrinsics is not fu, fv, pu, pv", fault_of(", 240.75]", "]"));
  expect_in("cam0.resolution is not width, height in pixels", fault_of("[640", "[0"));
  expect_in("key 'resolution' is missing", fault_of("resolution", "size"));
  expect_in("fx is -610.5, allowed: 0.001 to 100000", fault_of("[610.5", "[-610.5"));
  expect_in("has more than the five coefficients",
            fault_of("[0.1, 0.2, 0.0, 0.0]", "[0.1, 0, 0, 0, 0, 0.5]"));
  expect_in("'x', expected a number", fault_of("[610.5", "[x"));
}

}  // namespace
}  // namespace mms
