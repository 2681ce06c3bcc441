#include "mms/dataset/numbered/tartan_air.hpp"

#include "mms/core/error.hpp"
#include "mms/dataset/numbered/numbered_images.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kPoseNumbers = 7;

/// Rotation from this project's camera axes (right, down, forward) to forward, right, down.
Eigen::Matrix3d camera_axes() {
  Eigen::Matrix3d R_ned_camera;
  R_ned_camera << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return R_ned_camera;
}

Eigen::Isometry3d pose_of_ned(const TextLine& line, const std::string& where) {
  const std::vector<double> n = parse_finite(line.fields, where);
  if (n.size() != kPoseNumbers) throw DataError(where, "has not the seven numbers of a pose");
  const Eigen::Quaterniond rotation(n[6], n[3], n[4], n[5]);
  if (!(rotation.norm() > 0.0)) throw DataError(where, "has a quaternion of zeros");
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.translation() = Eigen::Vector3d(n[0], n[1], n[2]);
  T_world_camera.linear() = rotation.normalized().toRotationMatrix() * camera_axes();
  return T_world_camera;
}

}  // namespace

bool is_tartan_air_layout(const std::vector<std::string>& names) {
  return has_name(names, "image_left") && has_name(names, "depth_left");
}

std::unique_ptr<FrameSource> open_tartan_air(const fs::path& folder, const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = folder;
  recording.facts.emplace_back("layout: TartanAir, left camera");
  const auto numbers = add_numbered_frames(recording, {folder / "image_left", "", {"_left.png"}},
                                           {folder / "depth_left", "", {"_left_depth.npy"}});
  choose_calibration(recording, options.camera, [&] {
    recording.facts.emplace_back("calibration: that of TartanAir");
    Calibration calibration;
    calibration.camera = CameraIntrinsics{320.0, 320.0, 320.0, 240.0, 640, 480, {}};
    calibration.depth_scale = 1.0;
    return calibration;
  });
  const fs::path poses = folder / "pose_left.txt";
  if (fs::exists(poses)) add_pose_lines(recording, numbers, poses, pose_of_ned);
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
