#include "mms/simulation/sensors/sensor_preset.hpp"

#include <array>
#include <numbers>
#include <string>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array<std::string_view, 6> kNames{"l515",    "d435",    "kinect",
                                                 "lidar16", "lidar64", "livox"};

/// 640x480 camera of focal length `f` [px] with a principal point slightly off the center.
CameraIntrinsics vga_camera(double f, double cx, double cy, std::array<double, 5> distortion) {
  return {
      .fx = f, .fy = f, .cx = cx, .cy = cy, .width = 640, .height = 480, .distortion = distortion};
}

/// Intel RealSense LiDAR Camera L515, product brief and data sheet: depth 0.25 to 9 m,
/// standard deviation 2.5 mm at 1 m and 15.5 mm at 9 m on a 95 % reflective target, 3.9 m on a 15 %
/// one, units of 0.25 mm; color 69 x 42 degrees, which is f = 605 px at 640x480.
SensorPreset l515() {
  SensorPreset head;
  head.color.intrinsics = vga_camera(605.0, 321.4, 243.2, {0.08, -0.19, 0.0006, -0.0004, 0.0});
  DepthSensor depth;
  depth.noise.base = 0.002436;  // with `quadratic`: 2.5 mm at 1 m, 15.5 mm at 9 m
  depth.noise.quadratic = 1.7663e-4;
  depth.min_range = 0.25;
  depth.max_range = 9.0;
  depth.quantisation = DepthQuantisation::kDepth;
  depth.step = 0.00025;
  depth.lost_cosine = 0.08;
  depth.lost_darkness = 0.5;  // half of a 15 % target lost at 4 m, almost none of a 95 % one at 9 m
  depth.boundary_lost = 0.3;
  depth.boundary_mixed = 0.25;
  depth.boundary_reach = 1;
  head.depth = depth;
  head.depth_scale = 4000.0;
  return head;
}

/// Intel RealSense D435, D400 series data sheet (337029) and "Best-known methods for tuning" (Intel
/// white paper): baseline 50 mm, depth 87 degrees wide at 848 px, so f = 447 px and an error of
/// z^2 * subpixel / (f * baseline) = 0.0036 z^2 with 0.08 px; disparities in steps of 1/32 px.
SensorPreset d435() {
  SensorPreset head;
  head.color.intrinsics = vga_camera(615.0, 318.7, 241.6, {0.05, -0.12, -0.0004, 0.0005, 0.0});
  head.color.exposure = 0.010;
  DepthSensor depth;
  depth.noise.base = 0.0018;  // with `quadratic`: 0.0036 z^2 within 12 % from 1 to 10 m
  depth.noise.quadratic = 0.0043;
  depth.grazing_growth = 0.3;
  depth.min_range = 0.3;
  depth.max_range = 10.0;
  depth.quantisation = DepthQuantisation::kDisparity;
  depth.step = 1.0 / (32.0 * 447.0 * 0.050);
  depth.lost_cosine = 0.06;
  depth.lost_darkness = 0.02;  // passive light and a projector: brightness has little effect
  depth.boundary_lost = 0.35;
  depth.boundary_mixed = 0.35;
  depth.boundary_reach = 4;  // half of a matching window
  head.depth = depth;
  return head;
}

/// Microsoft Kinect v1: noise of Nguyen et al. (3DIMPVT 2012), depth from disparities of 1/8 px
/// with 2.85e-3 / m a step (Khoshelham and Elberink, Sensors 2012, 12(2)); default intrinsics and
/// units of 0.2 mm of the TUM RGB-D data set (Sturm et al., IROS 2012).
SensorPreset kinect() {
  SensorPreset head;
  head.color.intrinsics = vga_camera(525.0, 319.5, 239.5, {0.06, -0.11, -0.0008, 0.0005, 0.0});
  head.color.exposure = 0.015;
  head.color.read_noise = 1.5;
  head.color.shot_noise = 2.0;
  head.color.softness = 0.7;
  DepthSensor depth;
  depth.min_range = 0.4;
  depth.max_range = 8.0;
  depth.quantisation = DepthQuantisation::kDisparity;
  depth.step = 2.85e-3;
  depth.lost_darkness = 0.06;
  head.depth = depth;
  head.depth_scale = 5000.0;
  return head;
}

/// LiDAR 10 cm above and 3 cm behind the camera, with a small rotation.
Eigen::Isometry3d mount() {
  Eigen::Matrix3d axes;  // x right, y down, z forward of x forward, y left, z up
  axes << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const Eigen::Matrix3d tilt = (Eigen::AngleAxisd(0.4 * kDegree, Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(-0.6 * kDegree, Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(0.3 * kDegree, Eigen::Vector3d::UnitZ()))
                                   .toRotationMatrix();
  Eigen::Isometry3d T_camera_lidar = Eigen::Isometry3d::Identity();
  T_camera_lidar.linear() = tilt * axes;
  T_camera_lidar.translation() = Eigen::Vector3d(0.012, -0.100, -0.030);
  return T_camera_lidar;
}

/// A LiDAR on an industrial camera 70 degrees wide, both at 10 Hz.
SensorPreset lidar_head(const LidarSensor& lidar) {
  SensorPreset head;
  head.color.intrinsics = vga_camera(457.0, 320.8, 238.9, {-0.06, 0.04, 0.0003, -0.0002, 0.0});
  head.color.exposure = 0.005;
  head.lidar = lidar;
  head.T_camera_lidar = mount();
  head.hz = 10.0;
  return head;
}

/// Velodyne VLP-16 user manual (63-9243): +-15 degrees, 300 000 points/s (0.2 degrees at 10 Hz),
/// 100 m, accuracy +-3 cm.
SensorPreset lidar16() {
  LidarSensor lidar;
  lidar.rings = 16;
  lidar.columns = 1800;
  lidar.elevation_min = -15.0 * kDegree;
  lidar.elevation_max = 15.0 * kDegree;
  lidar.max_range = 100.0;
  lidar.noise = 0.02;
  return lidar_head(lidar);
}

/// Velodyne HDL-64E S2 data sheet: +2 to -24.8 degrees, 1.3 million points/s (2083 columns at 10
/// Hz), 120 m for 80 % and 50 m for 10 % reflectivity, accuracy below 2 cm. Its two blocks of rings
/// are modeled as one with even spacing.
SensorPreset lidar64() {
  LidarSensor lidar;
  lidar.rings = 64;
  lidar.columns = 2083;
  lidar.elevation_min = -24.8 * kDegree;
  lidar.elevation_max = 2.0 * kDegree;
  lidar.min_range = 0.9;
  lidar.max_range = 120.0;
  lidar.noise = 0.015;
  return lidar_head(lidar);
}

/// Livox Mid-40 user manual (2019): circular field 38.4 degrees wide, 100 000 points/s, 260 m for
/// 80 %, 130 m for 20 % and 90 m for 10 % reflectivity, range precision 2 cm.
SensorPreset livox() {
  LidarSensor lidar;
  lidar.pattern = LidarPattern::kRosette;
  lidar.field = 19.2 * kDegree;
  lidar.points = 10000;
  lidar.max_range = 260.0;
  lidar.noise = 0.02;
  return lidar_head(lidar);
}

}  // namespace

std::span<const std::string_view> sensor_names() {
  return kNames;
}

SensorPreset sensor_preset(std::string_view name) {
  using Make = SensorPreset (*)();
  constexpr std::array<Make, kNames.size()> kMake{l515, d435, kinect, lidar16, lidar64, livox};
  std::string known;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) {
      SensorPreset head = kMake[i]();
      head.name = kNames[i];
      return head;
    }
    known += (i == 0 ? "" : ", ") + std::string(kNames[i]);
  }
  throw DataError("sensor", "'" + std::string(name) + "' is none of " + known,
                  "choose one of them");
}

}  // namespace mms
