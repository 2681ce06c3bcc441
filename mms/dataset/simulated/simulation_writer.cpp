#include "mms/dataset/simulated/simulation_writer.hpp"

#include "mms/core/error.hpp"
#include "mms/dataset/recorder/recording_folder.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/motion/motion_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/atomic_file.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

PointCloudFile file_of(TruthCloud cloud) {
  PointCloudFile file;
  file.points = std::move(cloud.points);
  file.normals = std::move(cloud.normals);
  file.colors = std::move(cloud.colors);
  file.labels = std::move(cloud.labels);
  return file;
}

/// Poses from the first to the last frame with at least `rate` [Hz].
Trajectory dense_poses(const SimulatedScene& scene, int frames, double rate) {
  const Timestamp first = scene.stamp(0);
  const Timestamp last = scene.stamp(frames - 1);
  const auto step = Timestamp::from_seconds(1.0 / rate) - Timestamp();
  Trajectory poses;
  for (Timestamp stamp = first; stamp < last; stamp = stamp + step) {
    poses.push_back(scene.pose_at(stamp));
  }
  poses.push_back(scene.pose_at(last));
  return poses;
}

}  // namespace

SimulationWriter::SimulationWriter(const fs::path& folder, const SceneConfig& config,
                                   const SensorPreset& sensor, bool overwrite)
    : folder_(folder), lock_(folder) {
  prepare_recording_folder(folder, config, overwrite);
  layout_ = layout_for(folder, config, sensor);
}

void SimulationWriter::add(const SimulatedFrame& frame, const StampedPose& pose) {
  layout_->add(frame);
  truth_.push_back(pose);
  objects_.add(frame.frame.stamp, frame.objects);
  const auto image_id = static_cast<std::int64_t>(annotations_.images.size()) + 1;
  if (!frame.frame.color.empty()) {
    annotate(annotations_, frame, image_id, layout_->color_file(frame.frame));
  }
  map_.add(frame, pose.T_world_sensor);
}

void SimulationWriter::finish() {
  if (truth_.empty()) throw DataError(folder_.string(), "the recording has no frames");
  write_trajectory_tum(folder_ / "groundtruth.txt", truth_);
  write_file(folder_ / "objects_truth.json", objects_.json());
  if (!annotations_.images.empty()) write_coco(folder_ / "instances.json", annotations_);
  PointCloudFile map = file_of(map_.cloud());
  map_points_ = map.points.size();
  if (map_points_ > 0) write_ply(folder_ / "map_truth.ply", map);
  layout_->finish(truth_);
}

WrittenRecording write_simulation(SimulatedScene& scene, const fs::path& folder,
                                  const WriteOptions& options) {
  SimulationWriter writer(folder, scene.config(), scene.sensor(), options.overwrite);
  WrittenRecording written;
  bool go_on = true;
  while (go_on && written.frames < scene.size()) {
    const int index = written.frames++;
    writer.add(scene.render(index), scene.truth(index));
    go_on = !options.progress || options.progress(written.frames, scene.size());
  }
  const PointCloudFile fixed = file_of(scene.static_cloud(options.static_spacing));
  write_ply(folder / "static_truth.ply", fixed);
  const MotionSamples motion = scene.motion();
  if (!motion.wheels.empty()) write_wheels(folder / "odometry.csv", motion.wheels);
  if (!motion.imu.empty()) write_imu(folder / "imu.csv", motion.imu);
  write_trajectory_tum(folder / "groundtruth_dense.txt",
                       dense_poses(scene, written.frames, options.pose_rate));
  writer.finish();
  written.annotations = writer.annotations();
  written.static_points = fixed.points.size();
  written.map_points = writer.map_points();
  return written;
}

}  // namespace mms
