#include "mms/dataset/folder/folder_rgbd.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "mms/dataset/folder/sensor_info.hpp"
#include "mms/dataset/source/assumed_stamp.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/camera_matrix.hpp"
#include "mms/dataset/source/first_image.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/dataset/source/pose_file.hpp"
#include "mms/dataset/source/rgbd_source.hpp"
#include "mms/io/image/picture_files.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/natural_order.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// Words in the names of color images, and those of their depth images and poses in their place.
struct ImageWords {
  std::string_view color;
  std::string_view depth;
  std::string_view pose;
};
constexpr ImageWords kWords[] = {{"color", "depth", "pose"},
                                 {"Color", "Depth", "Pose"},
                                 {"rgb", "depth", "pose"},
                                 {"RGB", "Depth", "Pose"},
                                 {"rgb", "Depth", "pose"}};

/// The end of a color image's name of 7-Scenes, without ".png".
constexpr std::string_view kColorStem = ".color";

/// Names of the files of one frame.
struct FrameFiles {
  std::string color;
  std::string depth;
  std::string pose;  ///< a file that may be missing
  std::string name;  ///< of the frame
};

/// Files of both cameras, by ScanNet, BundleFusion and 3RScan.
constexpr const char* kInfoFiles[] = {"info.txt", "_info.txt"};

/// Camera matrix of all images, by 3DMatch; in the folder or above that of a sequence.
constexpr const char* kMatrixFile = "camera-intrinsics.txt";

bool is_seven_scenes(const FrameFiles& files) {
  return fs::path(files.color).stem().string().ends_with(kColorStem);
}

/// The frame of a color image with a depth image in the same folder, or of one of 7-Scenes.
/// @param names  of the folder, sorted
std::optional<FrameFiles> frame_of(const std::string& color,
                                   const std::vector<std::string>& names) {
  if (!is_picture(color)) return std::nullopt;
  const std::string stem = fs::path(color).stem().string();
  for (const ImageWords& words : kWords) {
    const std::size_t at = stem.rfind(words.color);
    if (at == std::string::npos) continue;
    const auto with = [&](std::string_view word) {
      return std::string(stem).replace(at, words.color.size(), word);
    };
    FrameFiles files{color, with(words.depth) + ".png", with(words.pose) + ".txt", stem};
    if (is_seven_scenes(files)) files.name.resize(stem.size() - kColorStem.size());
    for (const std::string& ending : depth_endings()) {
      const std::string depth = with(words.depth) + ending;
      if (!std::binary_search(names.begin(), names.end(), depth)) continue;
      files.depth = depth;
      return files;
    }
    if (is_seven_scenes(files)) return files;  // its missing depth image is reported
  }
  return std::nullopt;
}

/// In the order of the numbers in their names.
std::vector<FrameFiles> find_frames(const std::vector<std::string>& names) {
  std::vector<FrameFiles> frames;
  for (const std::string& name : names) {
    if (auto files = frame_of(name, names)) frames.push_back(std::move(*files));
  }
  std::stable_sort(frames.begin(), frames.end(), [](const FrameFiles& a, const FrameFiles& b) {
    return natural_less(a.color, b.color);
  });
  return frames;
}

/// Empty if there is none.
fs::path find_info(const fs::path& folder) {
  for (const char* name : kInfoFiles) {
    if (fs::exists(folder / name)) return folder / name;
  }
  return {};
}

/// Empty if there is none.
fs::path find_matrix(const fs::path& folder) {
  const fs::path whole = absolute_folder(folder);
  for (const fs::path& place : {whole, whole.parent_path()}) {
    if (fs::exists(place / kMatrixFile)) return place / kMatrixFile;
  }
  return {};
}

/// Colors are sampled for the depth camera where the color camera is another one.
Calibration read_info(RgbdRecording& recording, const fs::path& file) {
  const SensorInfo info = read_sensor_info(file);
  const std::string name = file.filename().string();
  if (info.color != info.depth) recording.color_camera = info.color;
  if (info.has_extrinsics) {
    recording.warnings.push_back(name + ": its extrinsics are ignored; both cameras are taken to " +
                                 "be at the same place");
  }
  Calibration calibration;
  calibration.camera = info.depth;
  calibration.depth_scale = info.depth_scale;
  recording.facts.push_back("calibration: " + name +
                            (recording.color_camera ? ", colors sampled by its color camera" : ""));
  return calibration;
}

Calibration read_matrix(RgbdRecording& recording, const fs::path& file) {
  const Image<float> first = first_depth(recording);
  Calibration calibration;
  calibration.camera = read_camera_matrix(file, first.width(), first.height());
  calibration.depth_scale = 1000.0;
  recording.facts.push_back("calibration: " + file.filename().string());
  return calibration;
}

Calibration seven_scenes_calibration(RgbdRecording& recording) {
  Calibration calibration;
  calibration.camera = CameraIntrinsics{585.0, 585.0, 320.0, 240.0, 640, 480, {}};
  calibration.depth_scale = 1000.0;
  recording.facts.emplace_back("calibration: default of 7-Scenes");
  return calibration;
}

std::optional<Calibration> calibration_of(RgbdRecording& recording, bool is_seven_scenes) {
  if (const fs::path info = find_info(recording.folder); !info.empty()) {
    return read_info(recording, info);
  }
  if (const fs::path matrix = find_matrix(recording.folder); !matrix.empty()) {
    return read_matrix(recording, matrix);
  }
  if (!is_seven_scenes) return std::nullopt;
  return seven_scenes_calibration(recording);
}

}  // namespace

bool is_folder_rgbd_layout(const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return frame_of(name, names).has_value(); });
}

std::unique_ptr<FrameSource> open_folder_rgbd(const fs::path& folder,
                                              const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = folder;
  recording.invalid_depth = 65535;
  const std::vector<FrameFiles> frames = find_frames(list_folder(folder));
  const bool seven_scenes = is_seven_scenes(frames.front());
  recording.facts.emplace_back(
      seven_scenes ? "layout: color, depth and pose files in one folder, as 7-Scenes"
                   : "layout: color and depth images in one folder");
  const AssumedRate& rate = seven_scenes ? kDataSetRate : kUnknownRate;
  std::vector<fs::path> poses;
  for (const FrameFiles& files : frames) {
    const auto index = static_cast<std::int64_t>(recording.frames.size());
    recording.frames.push_back({assumed_stamp(index, rate),
                                Duration::zero(),
                                folder / files.color,
                                folder / files.depth,
                                {},
                                files.name});
    poses.push_back(folder / files.pose);
  }
  recording.assumed_rate = rate;
  add_pose_files(recording, poses);  // NaN where tracking was lost
  choose_calibration(recording, options.camera,
                     [&] { return calibration_of(recording, seven_scenes); });
  sample_colors_of_arkit(recording);
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
