#include "mms/dataset/numbered/scannet.hpp"

#include "mms/core/error.hpp"
#include "mms/dataset/numbered/numbered_images.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/first_image.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/dataset/source/pose_file.hpp"
#include "mms/io/image/picture_files.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// The camera of a file with a 3x3 or 4x4 camera matrix; its size is that of `image`.
template <class T>
CameraIntrinsics read_camera(const fs::path& file, const Image<T>& image) {
  const TextTable table(file);
  std::vector<std::string_view> fields;
  for (const TextLine& line : table.lines()) {
    fields.insert(fields.end(), line.fields.begin(), line.fields.end());
  }
  const std::vector<double> m = parse_finite(fields, file.string());
  if (m.size() != 16 && m.size() != 9) {
    throw DataError(file.string(), "has " + std::to_string(m.size()) + " numbers",
                    "expected a 4x4 camera matrix");
  }
  const std::size_t side = m.size() == 16 ? 4 : 3;
  return {m[0], m[side + 1], m[2], m[side + 2], image.width(), image.height(), {}};
}

Calibration read_depth_camera(RgbdRecording& recording) {
  Calibration calibration;
  calibration.camera =
      read_camera(recording.folder / "intrinsic" / "intrinsic_depth.txt", first_depth(recording));
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
  recording.color_camera =
      read_camera(folder / "intrinsic" / "intrinsic_color.txt", first_color(recording));
  read_poses(recording, numbers);
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
