#include "mms/io/config/camera_json.hpp"

#include <array>

#include "mms/io/config/calibration_ranges.hpp"
#include "mms/io/config/json_entry.hpp"
#include "mms/io/text/pose_text.hpp"

namespace mms {
namespace {

Calibration read_nice_slam(const JsonEntry& camera) {
  Calibration calibration;
  calibration.camera = CameraIntrinsics{camera.at("fx").number(kFocalRange),
                                        camera.at("fy").number(kFocalRange),
                                        camera.at("cx").number(kPrincipalPointRange),
                                        camera.at("cy").number(kPrincipalPointRange),
                                        static_cast<int>(camera.at("w").integer(kImageSideRange)),
                                        static_cast<int>(camera.at("h").integer(kImageSideRange)),
                                        {}};
  calibration.depth_scale = camera.at("scale").number(kDepthScaleRange);
  return calibration;
}

Calibration read_open3d(const JsonEntry& file) {
  const auto matrix = file.at("intrinsic_matrix").elements();
  if (matrix.size() != 9) file.at("intrinsic_matrix").fail("has not nine numbers");
  Calibration calibration;
  calibration.camera =
      CameraIntrinsics{matrix[0].number(kFocalRange),
                       matrix[4].number(kFocalRange),
                       matrix[6].number(kPrincipalPointRange),
                       matrix[7].number(kPrincipalPointRange),
                       static_cast<int>(file.at("width").integer(kImageSideRange)),
                       static_cast<int>(file.at("height").integer(kImageSideRange)),
                       {}};
  if (file.has("depth_scale")) {
    calibration.depth_scale = file.at("depth_scale").number(kDepthScaleRange);
  }
  return calibration;
}

/// The numbers of a matrix, which is a list of rows.
std::vector<double> matrix_numbers_of(const JsonEntry& entry) {
  std::vector<double> numbers;
  for (const JsonEntry& row : entry.elements()) {
    for (const JsonEntry& element : row.elements()) numbers.push_back(element.number());
  }
  return numbers;
}

}  // namespace

std::map<std::string, PosedCamera> read_posed_cameras(const std::filesystem::path& path) {
  const nlohmann::json json = parse_json(path);
  const JsonEntry file(json, path.string());
  if (!file.is_object()) file.fail("is no object with frames");
  std::map<std::string, PosedCamera> cameras;
  for (const auto& [name, unused] : json.items()) {
    const JsonEntry frame = file.at(name);
    const char* pose = frame.has("aligned_pose") ? "aligned_pose" : "pose";
    const std::vector<double> matrix = matrix_numbers_of(frame.at("intrinsic"));
    if (matrix.size() != 9) frame.at("intrinsic").fail("has not nine numbers");
    PosedCamera& camera = cameras[name];
    camera.matrix = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(matrix.data());
    camera.T_world_camera = isometry_from_rows(matrix_numbers_of(frame.at(pose)),
                                               path.string() + ": " + name + "." + pose);
  }
  return cameras;
}

Calibration read_camera_json(const std::filesystem::path& path) {
  const nlohmann::json json = parse_json(path);
  const JsonEntry file(json, path.string());
  return file.has("camera") ? read_nice_slam(file.at("camera")) : read_open3d(file);
}

}  // namespace mms
