#include "mms/dataset/numbered/replica.hpp"

#include "mms/core/error.hpp"
#include "mms/dataset/numbered/numbered_images.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/io/config/camera_json.hpp"
#include "mms/io/image/picture_files.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr const char* kCameraFile = "cam_params.json";

/// The camera of NICE-SLAM's renderings.
Calibration default_camera() {
  Calibration calibration;
  calibration.camera = CameraIntrinsics{600.0, 600.0, 599.5, 339.5, 1200, 680, {}};
  calibration.depth_scale = 6553.5;
  return calibration;
}

Calibration find_camera_of_replica(RgbdRecording& recording) {
  for (const fs::path& folder : {recording.folder, fs::absolute(recording.folder) / ".."}) {
    const fs::path file = folder / kCameraFile;
    if (!fs::exists(file)) continue;
    recording.facts.push_back("calibration: " + file.lexically_normal().string());
    return read_camera_json(file);
  }
  recording.facts.emplace_back("calibration: that of NICE-SLAM's renderings");
  return default_camera();
}

Eigen::Isometry3d pose_of_matrix(const TextLine& line, const std::string& where) {
  return isometry_from_rows(parse_finite(line.fields, where), where);
}

}  // namespace

bool is_replica_layout(const std::vector<std::string>& names) {
  return has_name(names, "results") && has_name(names, "traj.txt");
}

std::unique_ptr<FrameSource> open_replica(const fs::path& folder, const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = folder;
  recording.facts.emplace_back("layout: Replica, as NICE-SLAM renders it");
  const auto numbers =
      add_numbered_frames(recording, {folder / "results", "frame", color_endings()},
                          {folder / "results", "depth", depth_endings()});
  choose_calibration(recording, options.camera, [&] { return find_camera_of_replica(recording); });
  add_pose_lines(recording, numbers, folder / "traj.txt", pose_of_matrix);
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
