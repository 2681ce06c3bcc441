#include "mms/dataset/recorder/recording_folder.hpp"

#include "mms/core/error.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/output_folder.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kSceneFile = "scene.yaml";

/// First line of scene.yaml, which identifies a simulated recording.
constexpr std::string_view kMark = "# A recording by mms simulate";

/// All entries of a recording.
constexpr std::string_view kEntries[] = {"rgb",
                                         "depth",
                                         "masks",
                                         "instances",
                                         "velodyne",
                                         "point_times",
                                         "image_2",
                                         "rgb.txt",
                                         "depth.txt",
                                         "times.txt",
                                         "poses.txt",
                                         "groundtruth.txt",
                                         "groundtruth_dense.txt",
                                         "odometry.csv",
                                         "imu.csv",
                                         "calibration.yaml",
                                         "objects_truth.json",
                                         "instances.json",
                                         "static_truth.ply",
                                         "map_truth.ply",
                                         kSceneFile};

bool is_simulation(const fs::path& folder) {
  const fs::path scene = folder / kSceneFile;
  return fs::is_regular_file(scene) && read_file(scene).starts_with(kMark);
}

void remove_simulation(const fs::path& folder) {
  for (const std::string_view entry : kEntries) {
    if (!fs::exists(folder / entry) || is_as_named(folder / entry)) continue;
    throw FileError((folder / entry).string(), "is not of an earlier simulation",
                    "choose a new folder with -o");
  }
  for (const std::string_view entry : kEntries) {
    std::error_code error;
    fs::remove_all(folder / entry, error);
    if (error) throw FileError((folder / entry).string(), "cannot be removed: " + error.message());
  }
}

}  // namespace

std::string scene_yaml(const SceneConfig& config) {
  return std::string(kMark) + " of '" + config.name +
         "'; recreate it with mms simulate scene.yaml -o DIR.\n" + dump_config(config);
}

void prepare_recording_folder(const fs::path& folder, const SceneConfig& config, bool overwrite) {
  make_folder(folder);
  const std::vector<std::string> names = list_folder(folder);
  if (is_simulation(folder)) {
    if (!overwrite) {
      throw FileError(folder.string(), "has an earlier simulation",
                      "replace it with --overwrite, or choose a new folder with -o");
    }
    remove_simulation(folder);
  } else if (!names.empty()) {
    throw FileError(folder.string(),
                    "is not empty (it has " + names.front() + ") and not an earlier simulation",
                    "choose a new folder with -o, or empty this one");
  }
  write_file(folder / kSceneFile, scene_yaml(config));
}

}  // namespace mms
