#include "mms/dataset/numbered/open3d.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "mms/core/error.hpp"
#include "mms/dataset/numbered/numbered_images.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/first_image.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/dataset/source/image_list.hpp"
#include "mms/io/config/camera_json.hpp"
#include "mms/io/image/picture_files.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// Open3D's names, and others in use.
constexpr const char* kColorFolders[] = {"color", "image", "rgb",   "colors", "images",
                                         "Color", "RGB",   "rgb_0", "color_0"};
constexpr const char* kDepthFolders[] = {"depth", "depths", "Depth", "depth_0"};
constexpr const char* kCameraFiles[] = {"camera_intrinsic.json", "intrinsic.json"};
constexpr const char* kTumLists[] = {"rgb.txt", "color.txt", "depth.txt"};
constexpr std::size_t kLinesPerPose = 5;  // one with numbers, four with a matrix

bool has_camera_file(const std::vector<std::string>& names) {
  return std::any_of(std::begin(kCameraFiles), std::end(kCameraFiles),
                     [&](const char* file) { return has_name(names, file); });
}

/// The first of the names that the folder has; nullptr for none.
template <std::size_t kCount>
const char* first_of(const std::vector<std::string>& names, const char* const (&wanted)[kCount]) {
  const auto* found = std::find_if(std::begin(wanted), std::end(wanted),
                                   [&](const char* name) { return has_name(names, name); });
  return found == std::end(wanted) ? nullptr : *found;
}

Calibration primesense_camera() {
  Calibration calibration;
  calibration.camera = CameraIntrinsics{525.0, 525.0, 319.5, 239.5, 640, 480, {}};
  calibration.depth_scale = 1000.0;
  return calibration;
}

std::optional<Calibration> find_camera(RgbdRecording& recording) {
  for (const char* name : kCameraFiles) {
    if (!fs::exists(recording.folder / name)) continue;
    recording.facts.push_back(std::string("calibration: ") + name);
    return read_camera_json(recording.folder / name);
  }
  const Image<Rgb> image = first_color(recording);
  const Calibration camera = primesense_camera();
  if (image.width() != camera.camera->width || image.height() != camera.camera->height) {
    return std::nullopt;
  }
  recording.facts.emplace_back("calibration: none; a PrimeSense camera (525 px) is assumed");
  return camera;
}

/// Poses of an Open3D trajectory: number of the image, and a camera-to-world matrix.
void read_trajectory_log(RgbdRecording& recording, const std::vector<std::int64_t>& numbers) {
  const fs::path file = recording.folder / "trajectory.log";
  if (!fs::exists(file)) return;
  const TextTable table(file);
  const auto& lines = table.lines();
  for (std::size_t i = 0; i + kLinesPerPose <= lines.size(); i += kLinesPerPose) {
    const std::string where = table.where(lines[i]);
    const auto number = parse_integer(lines[i].fields[0]);
    if (!number || lines[i].fields.size() != 3) {
      throw DataError(where, "is not the head of a pose", "expected three whole numbers");
    }
    std::vector<std::string_view> fields;
    for (std::size_t row = 1; row < kLinesPerPose; ++row) {
      fields.insert(fields.end(), lines[i + row].fields.begin(), lines[i + row].fields.end());
    }
    const auto pose = isometry_from_rows(parse_finite(fields, where), where);
    const auto image = std::lower_bound(numbers.begin(), numbers.end(), *number);
    if (image == numbers.end() || *image != *number) continue;
    const auto frame = static_cast<std::size_t>(image - numbers.begin());
    recording.ground_truth.push_back(
        {recording.frames[frame].stamp, Transform<World, Sensor>(pose)});
  }
  recording.facts.push_back("poses: trajectory.log, " +
                            std::to_string(recording.ground_truth.size()));
}

}  // namespace

bool is_open3d_layout(const std::vector<std::string>& names) {
  if (first_of(names, kTumLists) != nullptr || first_of(names, kPairNames) != nullptr) return false;
  const char* color = first_of(names, kColorFolders);
  const char* depth = first_of(names, kDepthFolders);
  if (color == nullptr || depth == nullptr) return false;
  const bool as_tum = color == std::string_view("rgb") && depth == std::string_view("depth");
  return !as_tum || has_camera_file(names);
}

std::unique_ptr<FrameSource> open_open3d(const fs::path& folder, const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = folder;
  recording.facts.emplace_back("layout: Open3D, numbered color and depth images");
  // Redwood's scans, at 30 Hz, have poses; others may be of any recorder.
  const bool is_redwood = fs::exists(folder / "trajectory.log");
  const std::vector<std::string> names = list_folder(folder);
  const auto numbers = add_numbered_frames(
      recording, find_series(folder / first_of(names, kColorFolders), color_endings()),
      find_series(folder / first_of(names, kDepthFolders), depth_endings()),
      is_redwood ? kDataSetRate : kUnknownRate);
  choose_calibration(recording, options.camera, [&] { return find_camera(recording); });
  sample_colors_of_arkit(recording);
  read_trajectory_log(recording, numbers);
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
