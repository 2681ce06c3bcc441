#include "mms/run/view/recorded_scene.hpp"

#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/global_map/loops/loop.hpp"
#include "mms/mapping/ground/floor.hpp"
#include "mms/run/record/recorded_run.hpp"
#include "mms/run/view/run_series.hpp"
#include "mms/run/view/sensor_views.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
/// Series in milliseconds: read, the stages and the interval between frames.
constexpr std::size_t kTimes = 2 + kStageCount;

double voxel_size_of(const RunFiles& files) {
  return files.record && files.record->voxel_size > 0.0 ? files.record->voxel_size
                                                        : files.config.static_map.voxel_size;
}

/// Up direction of the map's floor, else that of the sensor.
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

/// Indices of all frames in the recording; empty if one is unknown.
std::vector<FrameRecord> records_of(const RunFiles& files) {
  std::vector<FrameRecord> records;
  for (const StampedPose& pose : files.trajectory) {
    const auto found = files.frames.find(pose.stamp);
    if (found == files.frames.end()) return {};
    records.push_back(found->second);
  }
  return records;
}

/// Loader of the run's images, or a note with the reason if there is none.
Scene::ViewLoader make_loader(const RunFiles& files, std::string& note) {
  std::vector<FrameRecord> records = records_of(files);
  if (!files.record || records.empty()) {
    note = "the folder does not contain the recording's name and frame indices";
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
  const bool is_known = record != files.frames.end();
  values.push_back(is_known ? static_cast<float>(record->second.dynamic_share) : kUnknown);
  values.push_back(is_known && record->second.overruled_share
                       ? static_cast<float>(*record->second.overruled_share)
                       : kUnknown);
  values.push_back(static_cast<float>(frame.objects.size()));
  append_distances(values, frame, !files.truth.empty());
  return values;
}

std::vector<SceneFrame> frames_of(const RunFiles& files) {
  std::vector<SceneFrame> frames;
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
    frames.push_back(std::move(frame));
  }
  return frames;
}

/// Loops within the run; those to an earlier map have no frame of it.
std::vector<SceneLoop> loops_of(const RunFiles& files) {
  std::map<Timestamp, std::size_t> frames;
  for (const StampedPose& pose : files.trajectory) frames.emplace(pose.stamp, frames.size());
  std::vector<SceneLoop> loops;
  for (const LoopRecord& loop : files.loops) {
    const auto earlier = frames.find(loop.earlier);
    const auto later = frames.find(loop.later);
    if (earlier == frames.end() || later == frames.end()) continue;
    loops.push_back({earlier->second, later->second,
                     loop.outcome == to_string(LoopOutcome::kAccepted), loop.outcome});
  }
  return loops;
}

MapChanges map_of(const RunFiles& files) {
  return changes_of(files.map.points, files.map.colors, voxel_size_of(files));
}

}  // namespace

std::shared_ptr<Scene> open_recorded_scene(const fs::path& folder,
                                           std::vector<std::string>& warnings) {
  const RunFiles files = read_run_files(folder);
  warnings.insert(warnings.end(), files.warnings.begin(), files.warnings.end());
  SceneInfo info;
  Scene::ViewLoader loader = make_loader(files, info.pictures_note);
  info.name = name_of(folder, files.data);
  info.id = info.name + "-" + files.trajectory.front().stamp.to_string();
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
  for (SceneFrame& frame : frames_of(files)) scene->add(std::move(frame), nullptr, nullptr);
  scene->add_map(std::make_shared<const MapChanges>(map_of(files)));
  scene->set_loops(loops_of(files));
  scene->end(folder);
  return scene;
}

void show_final_results(const fs::path& folder, Scene& scene) {
  const RunFiles files = read_run_files(folder);
  std::vector<SceneFrame> frames = frames_of(files);
  scene.change(
      [&](std::size_t index, SceneFrame& frame) {
        if (index < frames.size()) frame = std::move(frames[index]);
      },
      std::make_shared<const MapChanges>(map_of(files)));
  scene.set_loops(loops_of(files));
}

}  // namespace mms
