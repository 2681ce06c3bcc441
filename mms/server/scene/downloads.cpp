#include "mms/server/scene/downloads.hpp"

#include <stdlib.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "mms/core/error.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/results/trajectory_io.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 19> kKnown = {
    "static_map.ply",       "static_map.pcd", "semantic_map.ply", "trajectory.tum",
    "trajectory_kitti.txt", "keyframes.tum",  "truth.tum",        "objects.json",
    "metrics.json",         "timing.csv",     "frames.csv",       "report.html",
    "config.yaml",          "map.pgm",        "map.yaml",         "map.bt",
    "trajectory_map.tum",   "loops.csv",      "run.mcap"};

constexpr std::array<std::string_view, 2> kLive = {"static_map.ply", "trajectory.tum"};

template <std::size_t n>
bool holds(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A new private folder.
fs::path new_temporary() {
  std::string folder = fs::temp_directory_path() / "mms-XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr) {
    throw FileError(folder, "a temporary folder cannot be created there",
                    "set TMPDIR to another folder");
  }
  return folder;
}

Trajectory trajectory_of(const Scene& scene) {
  Trajectory poses;
  scene.for_each_frame(0, scene.size(), [&](const SceneFrame& frame) {
    poses.push_back({frame.stamp, frame.T_world_sensor});
  });
  return poses;
}

PointCloudFile map_of(Scene& scene) {
  ColoredPoints cloud = scene.read_map([](const MapChunks& map) { return map.cloud(); });
  PointCloudFile file;
  file.points = std::move(cloud.points);
  file.colors = std::move(cloud.colors);
  return file;
}

}  // namespace

std::vector<std::string> download_names(const Scene& scene) {
  const fs::path folder = scene.folder();
  if (folder.empty()) return {kLive.begin(), kLive.end()};
  std::vector<std::string> names;
  for (const std::string_view name : kKnown) {
    if (find_download(folder, name)) names.emplace_back(name);
  }
  return names;
}

std::optional<fs::path> find_download(const fs::path& folder, std::string_view name) {
  if (!holds(kKnown, name)) return std::nullopt;
  const fs::path path = folder / name;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return std::nullopt;
  return path;
}

bool is_live_download(std::string_view name) {
  return holds(kLive, name);
}

std::unique_ptr<LiveDownload> write_live_download(Scene& scene, std::string_view name) {
  const fs::path folder = new_temporary();
  std::unique_ptr<LiveDownload> download(
      new LiveDownload{TemporaryPath(folder), TemporaryPath(folder / name)});
  if (name == "trajectory.tum") {
    write_trajectory_tum(download->file.path(), trajectory_of(scene));
  } else {
    write_ply(download->file.path(), map_of(scene));
  }
  return download;
}

}  // namespace mms
