#include "mms/run/results/run_map.hpp"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/map_file/map_composition.hpp"

namespace mms {

namespace fs = std::filesystem;

void check_map_options(const MapFileOptions& options, const SystemConfig& config) {
  if (options.map.empty() && options.save_map.empty() && !options.localize) return;
  const std::string option = options.map.empty() ? "--save-map" : "--map";
  if (options.localize && options.map.empty()) {
    throw DataError("--localize", "needs a map", "--map FILE");
  }
  if (options.localize && !options.save_map.empty()) {
    throw DataError("--save-map", "does not go with --localize, which changes no map");
  }
  if (!config.global_map.enabled) {
    throw DataError(option, "needs loop closure, but it is off", "leave out --loops off");
  }
  if (!options.save_map.empty() && fs::exists(options.save_map) && !options.overwrite) {
    throw FileError(options.save_map.string(), "exists",
                    "--map FILE goes on in it, --overwrite replaces it");
  }
}

namespace {

std::string size_of(const CameraIntrinsics& camera) {
  return fmt::format("{}x{}, fx {:.1f}", camera.width, camera.height, camera.fx);
}

/// Whether images of the two are of one camera: the sizes may differ.
bool is_like(const CameraIntrinsics& a, const CameraIntrinsics& b) {
  constexpr double kMaxDifference = 0.1;  // of the field of view
  if (a.width == 0 || b.width == 0) return true;
  return std::abs(a.fx / a.width - b.fx / b.width) < kMaxDifference * a.fx / a.width;
}

}  // namespace

RunMap::RunMap(const MapFileOptions& options, const SystemConfig& config) {
  session_.name = options.recording;
  session_.program = MMS_VERSION;
  set_settings(config);
  check_map_options(options, config);
  if (options.map.empty() && options.save_map.empty()) return;
  if (options.localize) use_ = MapUse::kLocalizeOnly;
  path_ = options.save_map.empty() ? options.map : options.save_map;
  if (options.map.empty()) {
    written_ = std::make_unique<MapFile>(path_, MapFile::Mode::kCreate);
  } else if (options.localize) {
    earlier_ = std::make_unique<MapFile>(path_, MapFile::Mode::kRead);
  } else if (options.save_map.empty()) {
    written_ = std::make_unique<MapFile>(path_, MapFile::Mode::kExtend);
  } else {
    written_ = std::make_unique<MapFile>(path_, options.map);
  }
}

void RunMap::set_settings(const SystemConfig& config) {
  session_.settings = dump_config(config);
}

void RunMap::load(SlamSystem& system, const Calibration* calibration,
                  const MapFile::WarningHandler& warn) {
  if (calibration != nullptr && calibration->camera) camera_ = *calibration->camera;
  const MapFile* file = earlier_ ? earlier_.get() : written_.get();
  if (file == nullptr || file->sessions().empty()) return;
  const MapSession& first = file->sessions().front();
  GlobalMapContent content = file->content(warn);
  has_scans_ = has_scans(content, 0);
  if (!has_scans_.value_or(false) && !is_like(first.camera, camera_)) {
    warn(
        fmt::format("the map is of another camera ({}) than the recording ({}): places may not be "
                    "recognized",
                    size_of(first.camera), size_of(camera_)));
  }
  system.restore(std::move(content), use_);
}

void RunMap::add(const FrameResult& frame) {
  check_sensor(frame);
  sessions_.resize(frame.session + std::size_t{1}, session_);
  MapSession& session = sessions_.back();
  if (session.frames++ == 0) session.begin = frame.odometry.stamp;
  session.end = frame.odometry.stamp;
}

void RunMap::check_sensor(const FrameResult& frame) const {
  const bool is_scan = !frame.cloud.organised();
  if (!has_scans_ || frame.cloud.points.empty() || is_scan == *has_scans_) return;
  throw DataError(path_.string(),
                  is_scan ? "is a map of depth images, but the recording has LiDAR scans"
                          : "is a map of LiDAR scans, but the recording has depth images",
                  "make a map with this sensor: leave out --map, and --save-map FILE");
}

bool RunMap::save(const SlamSystem& system, const MapFile::WarningHandler& warn) {
  if (!written_) return false;
  const GlobalMap& map = system.global_map();
  if (map.records().empty() || map.records().back().session < map.earlier_sessions()) {
    warn("no map is saved, since no frame became a keyframe");
    written_.reset();
    return false;
  }
  const std::vector<StampedMap> maps = system.mapping().session_maps();
  for (std::uint32_t i = 0; i < maps.size(); ++i) {
    if (!map.session_of_run(i)) continue;
    MapSession session = sessions_.at(i);
    session.voxel_size = maps[i].voxel_size;
    if (!map.records().back().is_scan()) session.camera = camera_;
    written_->add_session(session, maps[i], map.records());
  }
  written_->set_graph(map.poses(), map.loops());
  std::exchange(written_, nullptr)->commit();
  return true;
}

}  // namespace mms
