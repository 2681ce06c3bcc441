#include "recorded_scene.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "live_view.hpp"
#include "mms/core/error.hpp"
#include "mms/io/config_yaml.hpp"
#include "mms/io/journal.hpp"
#include "mms/io/numbers.hpp"
#include "mms/io/objects_io.hpp"
#include "mms/io/ply_io.hpp"
#include "mms/io/text_table.hpp"
#include "mms/io/trajectory_io.hpp"
#include "mms/mapping/floor.hpp"
#include "recovered_run.hpp"
#include "run_record.hpp"
#include "sensor_views.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kTimes = 1 + kStageCount;  ///< series of milliseconds: read and the stages

/// What a result folder holds, as far as it is there.
struct RunFiles {
  Trajectory trajectory;
  MapCloud map;
  ObjectHistory objects;
  Trajectory truth;
  std::map<Timestamp, std::vector<float>> times;  ///< milliseconds of read and the stages
  std::map<Timestamp, FrameRecord> frames;
  std::optional<RunRecord> record;
  SystemConfig config;
  std::string data;  ///< what was run, where that is known
};

/// Lines of timing.csv: stamp, read, the stages, and more.
std::map<Timestamp, std::vector<float>> read_times(const fs::path& file) {
  const TextTable table(file);
  std::map<Timestamp, std::vector<float>> times;
  for (const TextLine& line : table.lines()) {
    if (line.fields[0] == "stamp") continue;
    const auto stamp = parse_stamp(line.fields[0]);
    std::vector<float> values;
    for (std::size_t i = 1; i < line.fields.size() && i <= kTimes; ++i) {
      values.push_back(static_cast<float>(parse_double(line.fields[i]).value_or(kUnknown)));
    }
    if (!stamp || values.size() != kTimes) {
      throw DataError(table.where(line), "is no line of a run's timing.csv");
    }
    times[*stamp] = std::move(values);
  }
  return times;
}

MapCloud read_map(const fs::path& file) {
  PointCloudFile cloud = read_ply(file);
  MapCloud map;
  map.points = std::move(cloud.points);
  map.colors = std::move(cloud.colors);
  map.normals = std::move(cloud.normals);
  map.colors.resize(map.points.size(), Rgb{128, 128, 128});
  map.normals.resize(map.points.size(), Eigen::Vector3f::Zero());
  return map;
}

/// Settings of another version of the program are no reason to show nothing.
SystemConfig read_settings(const fs::path& file) {
  SystemConfig config;
  try {
    if (fs::exists(file)) load_config(file, config);
  } catch (const ConfigError&) {
    return SystemConfig();
  }
  return config;
}

RunFiles read_finished(const fs::path& folder) {
  RunFiles files;
  files.trajectory = read_trajectory_tum(folder / "trajectory.tum");
  const auto there = [&](const char* name) { return fs::exists(folder / name); };
  if (there("static_map.ply")) files.map = read_map(folder / "static_map.ply");
  if (there("objects.json")) files.objects = read_objects(folder / "objects.json");
  if (there("truth.tum")) files.truth = read_trajectory_tum(folder / "truth.tum");
  if (there("timing.csv")) files.times = read_times(folder / "timing.csv");
  if (there("frames.csv")) {
    for (const FrameRecord& frame : read_frame_records(folder / "frames.csv")) {
      files.frames[frame.stamp] = frame;
    }
  }
  if (there("run.json")) files.record = read_run_record(folder / "run.json");
  files.config = read_settings(folder / "config.yaml");
  if (files.record) files.data = files.record->data;
  return files;
}

RunFiles read_killed(const fs::path& journal) {
  RecoveredRun run = recover_run(journal);
  RunFiles files;
  files.trajectory = std::move(run.trajectory);
  files.map = std::move(run.map);
  files.config.static_map.voxel_size = run.header.voxel_size;
  files.data = run.header.data;
  return files;
}

RunFiles read_files(const fs::path& folder) {
  if (!fs::exists(folder)) {
    throw FileError(folder.string(), "is not there", "give the folder that mms run wrote to");
  }
  if (!fs::is_directory(folder)) {
    throw FileError(folder.string(), "is no folder", "give the folder that mms run wrote to");
  }
  if (fs::exists(folder / "trajectory.tum")) return read_finished(folder);
  if (fs::exists(folder / kJournalName)) return read_killed(folder / kJournalName);
  throw DataError(
      folder.string(),
      "holds no results of a run: neither trajectory.tum nor " + std::string(kJournalName),
      "give the folder that mms run wrote to; mms run --view shows a recording");
}

double voxel_size_of(const RunFiles& files) {
  return files.record && files.record->voxel_size > 0.0 ? files.record->voxel_size
                                                        : files.config.static_map.voxel_size;
}

/// Up as the map's floor says, else as the sensor was held.
Eigen::Vector3d up_of(const RunFiles& files) {
  const bool may_be_camera = !files.record || files.record->depth_camera;
  const bool may_be_lidar = !files.record || !files.record->depth_camera;
  const FloorConfig& config = files.config.occupancy.floor;
  Eigen::Vector3d up = (may_be_camera ? SensorAxes::camera() : SensorAxes::lidar()).up;
  if (files.map.size() == 0) return up;
  const Floor floor = find_floor(files.map, up, config);
  if (floor.found || !may_be_lidar || !may_be_camera) return floor.up;
  const Floor of_lidar = find_floor(files.map, SensorAxes::lidar().up, config);
  return of_lidar.found ? of_lidar.up : floor.up;
}

std::string name_of(const fs::path& folder, const std::string& data) {
  std::error_code ignored;
  const std::string run = fs::weakly_canonical(folder, ignored).filename().string();
  return run.empty() ? data : run;
}

/// The places of all frames in the recording; empty where one is not known.
std::vector<FrameRecord> records_of(const RunFiles& files) {
  std::vector<FrameRecord> records;
  for (const StampedPose& pose : files.trajectory) {
    const auto found = files.frames.find(pose.stamp);
    if (found == files.frames.end()) return {};
    records.push_back(found->second);
  }
  return records;
}

/// What gives the run's pictures, or a note that says why nothing does.
Scene::ViewLoader make_loader(const RunFiles& files, std::string& note) {
  std::vector<FrameRecord> records = records_of(files);
  if (!files.record || records.empty()) {
    note = "the folder does not say which frames of which recording were run";
    return nullptr;
  }
  try {
    const auto views =
        std::make_shared<SensorViews>(*files.record, files.config, std::move(records));
    return [views](std::size_t frame) { return views->load(frame); };
  } catch (const Error& error) {
    note = error.what();
    return nullptr;
  }
}

std::vector<float> series_of(const RunFiles& files, const SceneFrame& frame) {
  std::vector<float> values(kTimes, kUnknown);
  const auto times = files.times.find(frame.stamp);
  if (times != files.times.end()) values = times->second;
  const auto record = files.frames.find(frame.stamp);
  values.push_back(record == files.frames.end() ? kUnknown
                                                : static_cast<float>(record->second.dynamic_share));
  values.push_back(static_cast<float>(frame.objects.size()));
  if (files.truth.empty()) return values;
  values.push_back(
      frame.truth
          ? static_cast<float>(100.0 * (frame.T_world_sensor.translation() - *frame.truth).norm())
          : kUnknown);
  return values;
}

void add_frames(const RunFiles& files, Scene& scene) {
  std::map<Timestamp, const ObjectFrame*> objects;
  for (const ObjectFrame& frame : files.objects) objects[frame.stamp] = &frame;
  std::map<Timestamp, Eigen::Vector3d> truth;
  for (const StampedPose& pose : files.truth) {
    truth[pose.stamp] = pose.T_world_sensor.translation();
  }
  for (const StampedPose& pose : files.trajectory) {
    SceneFrame frame;
    frame.stamp = pose.stamp;
    frame.T_world_sensor = pose.T_world_sensor;
    const auto record = files.frames.find(pose.stamp);
    if (record != files.frames.end()) frame.status = record->second.status;
    const auto seen = objects.find(pose.stamp);
    if (seen != objects.end()) frame.objects = seen->second->objects;
    const auto truly = truth.find(pose.stamp);
    if (truly != truth.end()) frame.truth = truly->second;
    frame.series = series_of(files, frame);
    scene.add(std::move(frame), nullptr, nullptr);
  }
}

}  // namespace

std::shared_ptr<Scene> open_recorded_scene(const fs::path& folder) {
  const RunFiles files = read_files(folder);
  SceneInfo info;
  Scene::ViewLoader loader = make_loader(files, info.pictures_note);
  info.name = name_of(folder, files.data);
  info.data = files.data;
  info.frames = files.trajectory.size();
  info.has_truth = !files.truth.empty();
  info.has_pictures = loader != nullptr;
  info.voxel_size = voxel_size_of(files);
  info.up = up_of(files);
  info.series = run_series(info.has_truth);
  if (files.record) info.camera = files.record->camera;
  auto scene = std::make_shared<Scene>(std::move(info));
  scene->set_loader(std::move(loader));
  add_frames(files, *scene);
  scene->add_map(std::make_shared<const MapChanges>(
      changes_of(files.map.points, files.map.colors, voxel_size_of(files))));
  scene->end(folder);
  return scene;
}

}  // namespace mms
