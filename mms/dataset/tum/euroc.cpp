#include "mms/dataset/tum/euroc.hpp"

#include "mms/core/error.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/dataset/tum/matched_lists.hpp"
#include "mms/io/config/calibration_formats.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/stamp_reader.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTruth = "state_groundtruth_estimate0";

/// Poses of the camera from those of the body.
void read_body_poses(RgbdRecording& recording, const fs::path& file,
                     const Eigen::Isometry3d& T_body_camera) {
  constexpr std::size_t kNumbers = 8;  // stamp, position, quaternion; velocities and biases follow
  if (!fs::exists(file)) return;
  const TextTable table(file);
  const StampReader read_stamp(table, 0, kLongestImageStep);
  for (const TextLine& line : table.lines()) {
    const std::string where = table.where(line);
    const auto stamp = read_stamp(line.fields[0]);
    if (!stamp || line.fields.size() < kNumbers) {
      throw DataError(where, "is not a pose", "expected stamp,x,y,z,qw,qx,qy,qz");
    }
    const std::vector<std::string_view> fields(line.fields.begin() + 1,
                                               line.fields.begin() + kNumbers);
    const std::vector<double> n = parse_finite(fields, where);
    const Eigen::Quaterniond rotation(n[3], n[4], n[5], n[6]);
    if (!(rotation.norm() > 0.0)) throw DataError(where, "has a quaternion of zeros");
    Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
    T_world_body.translation() = Eigen::Vector3d(n[0], n[1], n[2]);
    T_world_body.linear() = rotation.normalized().toRotationMatrix();
    recording.ground_truth.push_back(
        {*stamp, Transform<World, Sensor>(T_world_body * T_body_camera)});
  }
  recording.facts.push_back(std::string("poses: ") + kTruth + ", " +
                            std::to_string(recording.ground_truth.size()));
}

/// Depth images with a camera of their own are registered. Registered ones have that of cam0.
void add_depth_camera(RgbdRecording& recording, const Eigen::Isometry3d& T_body_color,
                      Calibration& calibration) {
  const fs::path file = recording.folder / "depth0" / "sensor.yaml";
  if (!fs::exists(file)) return;
  const FormattedCalibration depth = read_any_calibration(file);
  if (!depth.calibration.camera || !depth.T_body_camera) return;
  const Eigen::Isometry3d T_color_depth = T_body_color.inverse() * *depth.T_body_camera;
  if (*depth.calibration.camera == *calibration.camera &&
      T_color_depth.isApprox(Eigen::Isometry3d::Identity()))
    return;
  calibration.depth_camera =
      DepthCamera{*depth.calibration.camera, Transform<Camera, Depth>(T_color_depth)};
}

}  // namespace

bool is_euroc_layout(const std::vector<std::string>& names) {
  return has_name(names, "mav0") || (has_name(names, "cam0") && has_name(names, "depth0"));
}

std::unique_ptr<FrameSource> open_euroc(const fs::path& folder, const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = fs::is_directory(folder / "mav0") ? folder / "mav0" : folder;
  recording.facts.emplace_back("layout: EuRoC with depth");
  const auto list_of = [&](const char* sensor) {
    const fs::path list = recording.folder / sensor / "data.csv";
    if (fs::exists(list)) return read_image_list(list, recording.warnings, "data");
    throw DataError(
        recording.folder.string(),
        std::string("is in the layout of EuRoC, but ") + sensor + "/data.csv is missing",
        "depth images in depth0/ are needed; stereo and IMU are not used");
  };
  add_matched_frames(recording, list_of("cam0"), list_of("depth0"));
  const fs::path sensor = recording.folder / "cam0" / "sensor.yaml";
  FormattedCalibration camera;
  if (fs::exists(sensor)) camera = read_any_calibration(sensor);
  choose_calibration(recording, options.camera, [&]() -> std::optional<Calibration> {
    if (!camera.calibration.camera) return std::nullopt;
    recording.facts.emplace_back("calibration: cam0/sensor.yaml, 1000 depth units per meter");
    if (camera.T_body_camera) {
      add_depth_camera(recording, *camera.T_body_camera, camera.calibration);
    }
    return camera.calibration;
  });
  read_body_poses(recording, recording.folder / kTruth / "data.csv",
                  camera.T_body_camera.value_or(Eigen::Isometry3d::Identity()));
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
