#include "mms/io/config/calibration_io.hpp"

#include <algorithm>
#include <span>

#include "mms/core/error.hpp"
#include "mms/io/config/calibration_ranges.hpp"
#include "mms/io/config/yaml_map.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/pose_text.hpp"

namespace mms {
namespace {

constexpr Range kLens{-1e4, 1e4};
constexpr std::string_view kCameraKeys[] = {
    "fx", "fy", "cx", "cy", "width", "height", "distortion", "depth_scale", "max_depth"};

YAML::Node required(YamlMap& map, const std::string& file, std::string_view key) {
  const auto node = map.find(key);
  if (node) return *node;
  throw ConfigError(file, "key '" + std::string(key) + "' is missing",
                    "a camera needs fx fy cx cy width height depth_scale");
}

/// Flattens a list, or a list of rows.
std::vector<double> matrix_numbers(const YamlMap& map, const YAML::Node& node,
                                   std::string_view key) {
  if (!node.IsSequence()) map.fail(node, key, "is " + shown(node) + ", expected a matrix");
  constexpr std::size_t kMaxNumbers = 100;  // aliases may multiply them
  std::vector<double> numbers;
  for (const YAML::Node& element : node) {
    if (element.IsSequence()) {
      for (const YAML::Node& number : element) {
        numbers.push_back(map.number(number, key, kPrincipalPointRange));
        if (numbers.size() > kMaxNumbers) break;
      }
    } else {
      numbers.push_back(map.number(element, key, kPrincipalPointRange));
    }
    if (numbers.size() > kMaxNumbers) map.fail(node, key, "has more than 100 numbers");
  }
  return numbers;
}

std::array<double, 5> read_distortion(const YamlMap& map, const YAML::Node& node) {
  constexpr std::string_view kKey = "distortion";
  const bool list = node.IsSequence() && (node.size() == 4 || node.size() == 5);
  if (!list) map.fail(node, kKey, "is not a list of 4 or 5 numbers", "k1 k2 p1 p2 [k3]");
  std::array<double, 5> distortion{};
  for (std::size_t i = 0; i < node.size(); ++i) {
    distortion[i] = map.number(node[i], kKey, kLens);
  }
  return distortion;
}

CameraIntrinsics read_camera(YamlMap& map, const std::string& file) {
  const auto number = [&](std::string_view key, Range range) {
    return map.number(required(map, file, key), key, range);
  };
  const auto integer = [&](std::string_view key) {
    return map.integer(required(map, file, key), key, kImageSideRange);
  };
  CameraIntrinsics camera;
  camera.fx = number("fx", kFocalRange);
  camera.fy = number("fy", kFocalRange);
  camera.cx = number("cx", kPrincipalPointRange);
  camera.cy = number("cy", kPrincipalPointRange);
  camera.width = integer("width");
  camera.height = integer("height");
  if (const auto node = map.find("distortion")) camera.distortion = read_distortion(map, *node);
  return camera;
}

Eigen::Isometry3d read_transform(const YamlMap& map, const YAML::Node& node, std::string_view key) {
  try {
    return isometry_from_rows(matrix_numbers(map, node, key), std::string(key));
  } catch (const DataError& error) {
    map.fail(node, key, std::string("is not a rigid transform: ") + error.what());
  }
}

DepthCamera read_depth_camera(YamlMap map, const std::string& file) {
  DepthCamera depth;
  depth.camera = read_camera(map, file + ": depth_camera");
  const YAML::Node transform = required(map, file + ": depth_camera", "T_color_depth");
  depth.T_color_depth = Transform<Camera, Depth>(read_transform(map, transform, "T_color_depth"));
  map.reject_unknown();
  return depth;
}

/// Largest difference of two clocks that is a delay [s].
constexpr Range kDelay{-1.0, 1.0};

Duration read_delay(YamlMap& map, std::string_view key) {
  const auto node = map.find(key);
  return node ? Timestamp::from_seconds(map.number(*node, key, kDelay)) - Timestamp() : Duration(0);
}

MotionCalibration read_motion(YamlMap& map) {
  MotionCalibration motion;
  if (const auto node = map.find("T_sensor_base")) {
    motion.T_sensor_base = Transform<Sensor, Base>(read_transform(map, *node, "T_sensor_base"));
  }
  if (const auto node = map.find("T_sensor_imu")) {
    motion.T_sensor_imu = Transform<Sensor, Imu>(read_transform(map, *node, "T_sensor_imu"));
  }
  motion.wheel_delay = read_delay(map, "wheel_delay");
  motion.imu_delay = read_delay(map, "imu_delay");
  return motion;
}

std::string list(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "[" : ", ") + format_number(number);
  return text + "]";
}

std::string camera_text(const CameraIntrinsics& camera, const std::string& indent) {
  return indent + "fx: " + format_number(camera.fx) + "  # [px]\n" +   //
         indent + "fy: " + format_number(camera.fy) + "\n" +           //
         indent + "cx: " + format_number(camera.cx) + "\n" +           //
         indent + "cy: " + format_number(camera.cy) + "\n" +           //
         indent + "width: " + std::to_string(camera.width) + "\n" +    //
         indent + "height: " + std::to_string(camera.height) + "\n" +  //
         indent + "distortion: " + list(camera.distortion) + "  # k1 k2 p1 p2 k3\n";
}

std::string rows_text(const Eigen::Isometry3d& transform) {
  const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows = transform.matrix().topRows<3>();
  return list(std::span(rows.data(), 12)) + "  # 3x4, row by row [m]\n";
}

std::string motion_text(const MotionCalibration& motion) {
  std::string text;
  const auto delay = [&](const char* key, Duration value) {
    if (value != Duration(0)) {
      text += std::string(key) + ": " + format_number(to_seconds(value)) + "  # [s]\n";
    }
  };
  if (motion.T_sensor_base) {
    text += "T_sensor_base: " + rows_text(motion.T_sensor_base->isometry());
  }
  if (motion.T_sensor_imu) text += "T_sensor_imu: " + rows_text(motion.T_sensor_imu->isometry());
  delay("wheel_delay", motion.wheel_delay);
  delay("imu_delay", motion.imu_delay);
  return text;
}

}  // namespace

Calibration read_calibration(const std::filesystem::path& path) {
  YamlMap map = YamlMap::load(path);
  Calibration calibration;
  if (const auto node = map.find("T_camera_lidar")) {
    calibration.T_camera_lidar =
        Transform<Camera, Lidar>(read_transform(map, *node, "T_camera_lidar"));
  }
  calibration.motion = read_motion(map);
  const auto camera =
      std::count_if(std::begin(kCameraKeys), std::end(kCameraKeys),
                    [&](std::string_view key) { return map.find(key).has_value(); });
  const bool has_depth_camera = map.find("depth_camera").has_value();
  map.reject_unknown();
  if (camera == 0 && !has_depth_camera) return calibration;
  calibration.camera = read_camera(map, path.string());
  calibration.depth_scale =
      map.number(required(map, path.string(), "depth_scale"), "depth_scale", kDepthScaleRange);
  if (const auto node = map.find("max_depth")) {
    calibration.max_depth = map.number(*node, "max_depth", kMaxDepthRange);
  }
  if (has_depth_camera) {
    calibration.depth_camera = read_depth_camera(map.child("depth_camera"), path.string());
  }
  return calibration;
}

void write_calibration(const std::filesystem::path& path, const Calibration& calibration) {
  std::string text;
  if (calibration.camera) {
    text += camera_text(*calibration.camera, "");
    text += "depth_scale: " + format_number(calibration.depth_scale) + "  # units per meter\n";
    if (calibration.max_depth) {
      text += "max_depth: " + format_number(*calibration.max_depth) + "  # [m]\n";
    }
  }
  if (calibration.depth_camera) {
    text += "depth_camera:\n" + camera_text(calibration.depth_camera->camera, "  ");
    text += "  T_color_depth: " + rows_text(calibration.depth_camera->T_color_depth.isometry());
  }
  text += "T_camera_lidar: " + rows_text(calibration.T_camera_lidar.isometry());
  text += motion_text(calibration.motion);
  write_file(path, text);
}

}  // namespace mms
