#include "mms/dataset/folder/folder_rgbd.hpp"

#include <algorithm>

#include "mms/dataset/source/assumed_stamp.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/pose_file.hpp"
#include "mms/dataset/source/rgbd_source.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kColorEndings[] = {".color.png", ".color.jpg", ".color.jpeg"};

/// Prefix of a color image's name; empty for other files.
std::string frame_name(const std::string& file) {
  for (const std::string_view ending : kColorEndings) {
    if (file.ends_with(ending)) return file.substr(0, file.size() - ending.size());
  }
  return "";
}

Calibration seven_scenes_calibration() {
  Calibration calibration;
  calibration.camera = CameraIntrinsics{585.0, 585.0, 320.0, 240.0, 640, 480, {}};
  calibration.depth_scale = 1000.0;
  return calibration;
}

}  // namespace

bool is_folder_rgbd_layout(const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [](const std::string& name) { return !frame_name(name).empty(); });
}

std::unique_ptr<FrameSource> open_folder_rgbd(const fs::path& folder,
                                              const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = folder;
  recording.invalid_depth = 65535;
  recording.facts.emplace_back("layout: 7-Scenes, folder of color, depth and pose files");
  std::vector<fs::path> poses;
  for (const std::string& file : list_folder(folder)) {
    const std::string name = frame_name(file);
    if (name.empty()) continue;
    const auto index = static_cast<std::int64_t>(recording.frames.size());
    const Timestamp stamp = assumed_stamp(index);
    recording.frames.push_back(
        {stamp, Duration::zero(), folder / file, folder / (name + ".depth.png"), {}, name});
    poses.push_back(folder / (name + ".pose.txt"));
  }
  add_pose_files(recording, poses);  // NaN where tracking was lost
  choose_calibration(recording, options.camera, [&] {
    recording.facts.emplace_back("calibration: default of 7-Scenes");
    return seven_scenes_calibration();
  });
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
