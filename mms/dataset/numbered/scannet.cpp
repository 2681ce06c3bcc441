#include "mms/dataset/numbered/scannet.hpp"

#include "mms/dataset/numbered/numbered_images.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/camera_matrix.hpp"
#include "mms/dataset/source/first_image.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/dataset/source/pose_file.hpp"
#include "mms/io/image/picture_files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// Its size is that of `image`.
template <class T>
CameraIntrinsics read_camera(const RgbdRecording& recording, const char* file,
                             const Image<T>& image) {
  return read_camera_matrix(recording.folder / "intrinsic" / file, image.width(), image.height());
}

Calibration read_depth_camera(RgbdRecording& recording) {
  Calibration calibration;
  calibration.camera = read_camera(recording, "intrinsic_depth.txt", first_depth(recording));
  calibration.depth_scale = 1000.0;
  recording.facts.emplace_back(
      "calibration: intrinsic/intrinsic_depth.txt, colors sampled by "
      "intrinsic_color.txt");
  return calibration;
}

void read_poses(RgbdRecording& recording, const std::vector<std::int64_t>& numbers) {
  std::vector<fs::path> files;
  for (const std::int64_t number : numbers) {
    files.push_back(recording.folder / "pose" / (std::to_string(number) + ".txt"));
  }
  add_pose_files(recording, files);
}

}  // namespace

bool is_scannet_layout(const std::vector<std::string>& names) {
  return has_name(names, "color") && has_name(names, "depth") && has_name(names, "intrinsic");
}

std::unique_ptr<FrameSource> open_scannet(const fs::path& folder, const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = folder;
  recording.facts.emplace_back("layout: ScanNet, exported");
  const auto numbers = add_numbered_frames(recording, {folder / "color", "", color_endings()},
                                           {folder / "depth", "", depth_endings()});
  choose_calibration(recording, options.camera, [&] { return read_depth_camera(recording); });
  recording.color_camera = read_camera(recording, "intrinsic_color.txt", first_color(recording));
  read_poses(recording, numbers);
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
