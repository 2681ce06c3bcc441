#include "mms/io/config/calibration_formats.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/config/calibration_io.hpp"
#include "mms/io/config/calibration_ranges.hpp"
#include "mms/io/config/camera_json.hpp"
#include "mms/io/config/yaml_map.hpp"
#include "mms/io/text/lower_case.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/pose_text.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// A mapping with the names that its keys have in a format.
class CameraMap {
 public:
  CameraMap(YamlMap& map, std::string file) : map_(map), file_(std::move(file)) {}

  /// The value of the first of the keys that is there.
  std::optional<YAML::Node> find(std::span<const char* const> keys) {
    for (const char* key : keys) {
      if (auto node = map_.find(key)) return node;
    }
    return std::nullopt;
  }

  YAML::Node required(std::span<const char* const> keys) {
    if (auto node = find(keys)) return *node;
    throw ConfigError(file_, "key '" + std::string(keys.front()) + "' is missing");
  }

  double number(const char* key, Range range) {
    return map_.number(required(std::array{key}), key, range);
  }

  double number_or(const char* key, Range range, double fallback) {
    const auto node = map_.find(key);
    return node ? map_.number(*node, key, range) : fallback;
  }

  int side(std::span<const char* const> keys) {
    return map_.integer(required(keys), keys.front(), kImageSideRange);
  }

  /// The numbers of a list, or of the `data` of an OpenCV matrix.
  std::vector<double> numbers(const YAML::Node& node, const char* key) {
    const YAML::Node data = node.IsMap() && node["data"] ? node["data"] : node;
    if (!data.IsSequence()) map_.fail(node, key, "is " + shown(data) + ", expected numbers");
    constexpr std::size_t kMaxNumbers = 100;  // aliases may multiply them
    std::vector<double> values;
    for (const YAML::Node& row : data) {
      if (!row.IsSequence()) {
        values.push_back(map_.number(row, key, kAnyNumber));
        if (values.size() > kMaxNumbers) map_.fail(node, key, "has more than 100 numbers");
        continue;
      }
      for (const YAML::Node& element : row) {
        values.push_back(map_.number(element, key, kAnyNumber));
        if (values.size() > kMaxNumbers) break;
      }
      if (values.size() > kMaxNumbers) map_.fail(node, key, "has more than 100 numbers");
    }
    return values;
  }

  /// @throws ConfigError for a model other than these; an absent key is fine.
  void check_model(const char* key, std::span<const char* const> known) {
    const auto node = map_.find(key);
    if (!node || !node->IsScalar()) return;
    const std::string model = lower_case(node->Scalar());
    if (std::find(known.begin(), known.end(), model) != known.end()) return;
    map_.fail(*node, key, "is '" + node->Scalar() + "', which is not supported",
              "undistort the images, or give a pinhole camera with plumb_bob coefficients");
  }

  [[noreturn]] void fail(const YAML::Node& node, const char* key, const std::string& what) {
    map_.fail(node, key, what);
  }

 private:
  static constexpr Range kAnyNumber{-1e6, 1e6};

  YamlMap& map_;
  std::string file_;
};

constexpr const char* kPinhole[] = {"pinhole", "rectified", "perspective"};
constexpr const char* kPlumbBob[] = {
    "plumb_bob", "radtan", "radial-tangential", "brown_conrady", "rational_polynomial", "none", ""};

/// Coefficients k1 k2 p1 p2 k3; further ones must be zero.
std::array<double, 5> distortion_of(CameraMap& map, const YAML::Node& node, const char* key) {
  const std::vector<double> values = map.numbers(node, key);
  std::array<double, 5> distortion{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i < distortion.size()) {
      distortion[i] = values[i];
    } else if (values[i] != 0.0) {
      map.fail(node, key, "has more than the five coefficients k1 k2 p1 p2 k3");
    }
  }
  return distortion;
}

constexpr const char* kMatrix[] = {"camera_matrix", "Camera_Matrix", "cameraMatrix", "K"};

CameraIntrinsics camera_of_matrix(CameraMap& map) {
  constexpr const char* kCoefficients[] = {"distortion_coefficients", "Distortion_Coefficients",
                                           "distCoeffs", "dist_coeffs", "D"};
  constexpr const char* kWidth[] = {"image_width", "image_Width", "width"};
  constexpr const char* kHeight[] = {"image_height", "image_Height", "height"};
  map.check_model("distortion_model", kPlumbBob);
  const YAML::Node matrix = map.required(kMatrix);
  const std::vector<double> k = map.numbers(matrix, kMatrix[0]);
  if (k.size() != 9) {
    map.fail(matrix, kMatrix[0], "has " + std::to_string(k.size()) + " numbers, expected nine");
  }
  CameraIntrinsics camera{k[0], k[4], k[2], k[5], map.side(kWidth), map.side(kHeight), {}};
  if (const auto node = map.find(kCoefficients)) {
    camera.distortion = distortion_of(map, *node, kCoefficients[0]);
  }
  return camera;
}

/// A camera of Kalibr, or EuRoC's sensor.yaml.
CameraIntrinsics camera_of_lists(CameraMap& map) {
  constexpr const char* kIntrinsics[] = {"intrinsics"};
  constexpr const char* kResolution[] = {"resolution"};
  constexpr const char* kCoefficients[] = {"distortion_coeffs", "distortion_coefficients"};
  map.check_model("camera_model", kPinhole);
  map.check_model("distortion_model", kPlumbBob);
  const YAML::Node intrinsics = map.required(kIntrinsics);
  const YAML::Node resolution = map.required(kResolution);
  const std::vector<double> k = map.numbers(intrinsics, kIntrinsics[0]);
  const std::vector<double> size = map.numbers(resolution, kResolution[0]);
  if (k.size() != 4) map.fail(intrinsics, kIntrinsics[0], "is not fu, fv, pu, pv");
  const auto is_side = [](double side) { return side >= 1.0 && side <= kMaxImageSide; };
  if (size.size() != 2 || !is_side(size[0]) || !is_side(size[1])) {
    map.fail(resolution, kResolution[0], "is not width, height in pixels");
  }
  CameraIntrinsics camera{
      k[0], k[1], k[2], k[3], static_cast<int>(size[0]), static_cast<int>(size[1]), {}};
  if (const auto node = map.find(kCoefficients)) {
    camera.distortion = distortion_of(map, *node, kCoefficients[0]);
  }
  return camera;
}

/// The color camera of OpenLORIS, whose intrinsics are fx, cx, fy, cy.
CameraIntrinsics camera_of_openloris(CameraMap& map) {
  constexpr const char* kIntrinsics[] = {"intrinsics"};
  constexpr const char* kCoefficients[] = {"distortion_coefficients"};
  constexpr const char* kWidth[] = {"width"};
  constexpr const char* kHeight[] = {"height"};
  map.check_model("model", kPinhole);
  map.check_model("distortion_model", kPlumbBob);
  const YAML::Node intrinsics = map.required(kIntrinsics);
  const std::vector<double> k = map.numbers(intrinsics, kIntrinsics[0]);
  if (k.size() != 4) map.fail(intrinsics, kIntrinsics[0], "is not fx, cx, fy, cy");
  CameraIntrinsics camera{k[0], k[2], k[1], k[3], map.side(kWidth), map.side(kHeight), {}};
  if (const auto node = map.find(kCoefficients)) {
    camera.distortion = distortion_of(map, *node, kCoefficients[0]);
  }
  return camera;
}

std::optional<Eigen::Isometry3d> pose_in_body(CameraMap& map, const fs::path& path) {
  constexpr const char* kKey = "T_BS";
  const auto node = map.find(std::array{kKey});
  if (!node) return std::nullopt;
  return isometry_from_rows(map.numbers(*node, kKey), path.string() + ": " + kKey);
}

/// ORB-SLAM2 (prefix "Camera.") and ORB-SLAM3 ("Camera1.").
CameraIntrinsics camera_of_orb_slam(CameraMap& map, const std::string& prefix) {
  constexpr Range kLens{-1e4, 1e4};
  const auto coefficient = [&](const char* name) {
    return map.number_or((prefix + name).c_str(), kLens, 0.0);
  };
  map.check_model("Camera.type", kPinhole);
  return {map.number((prefix + "fx").c_str(), kFocalRange),
          map.number((prefix + "fy").c_str(), kFocalRange),
          map.number((prefix + "cx").c_str(), kPrincipalPointRange),
          map.number((prefix + "cy").c_str(), kPrincipalPointRange),
          map.side(std::array{"Camera.width"}),
          map.side(std::array{"Camera.height"}),
          {coefficient("k1"), coefficient("k2"), coefficient("p1"), coefficient("p2"),
           coefficient("k3")}};
}

FormattedCalibration with_camera(const char* format, const CameraIntrinsics& camera,
                                 const fs::path& path) {
  check_camera(camera, path.string());
  FormattedCalibration result{{}, format, std::nullopt, true};
  result.calibration.camera = camera;
  return result;
}

FormattedCalibration read_orb_slam(CameraMap& map, const std::string& prefix,
                                   const fs::path& path) {
  FormattedCalibration result = with_camera("ORB-SLAM", camera_of_orb_slam(map, prefix), path);
  for (const char* key : {"DepthMapFactor", "RGBD.DepthMapFactor"}) {
    if (!map.find(std::array{key})) continue;
    result.calibration.depth_scale = map.number(key, kDepthScaleRange);
    result.assumed_depth_scale = false;
  }
  return result;
}

}  // namespace

void check_camera(const CameraIntrinsics& camera, const std::string& where) {
  const auto check = [&](const char* name, double value, Range range) {
    if (value >= range.min && value <= range.max) return;
    throw ConfigError(where, std::string(name) + " is " + format_number(value) +
                                 ", allowed: " + to_string(range));
  };
  check("fx", camera.fx, kFocalRange);
  check("fy", camera.fy, kFocalRange);
  check("cx", camera.cx, kPrincipalPointRange);
  check("cy", camera.cy, kPrincipalPointRange);
  check("width", camera.width, kImageSideRange);
  check("height", camera.height, kImageSideRange);
}

FormattedCalibration read_any_calibration(const fs::path& path) {
  if (path.extension() == ".json")
    return {read_camera_json(path), "Open3D or NICE-SLAM", std::nullopt, false};
  YamlMap file = YamlMap::load(path);
  CameraMap map(file, path.string());
  const auto has = [&](const char* key) { return file.find(key).has_value(); };
  for (const char* prefix : {"Camera1.", "Camera."}) {
    if (has((std::string(prefix) + "fx").c_str())) return read_orb_slam(map, prefix, path);
  }
  if (has("cam0")) {
    YamlMap camera = file.child("cam0");
    CameraMap first(camera, path.string());
    return with_camera("Kalibr", camera_of_lists(first), path);
  }
  constexpr const char* kOpenLoris = "d400_color_optical_frame";
  if (has(kOpenLoris)) {
    YamlMap camera = file.child(kOpenLoris);
    CameraMap color(camera, path.string());
    return with_camera("OpenLORIS", camera_of_openloris(color), path);
  }
  if (has("intrinsics")) {
    FormattedCalibration result = with_camera("EuRoC", camera_of_lists(map), path);
    result.T_body_camera = pose_in_body(map, path);
    return result;
  }
  if (map.find(kMatrix)) return with_camera("ROS or OpenCV", camera_of_matrix(map), path);
  return {read_calibration(path), "MMS-SLAM", std::nullopt, false};
}

}  // namespace mms
