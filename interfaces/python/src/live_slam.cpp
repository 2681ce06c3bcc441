#include "interfaces/python/src/live_slam.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "mms/geometry/noise_measurement.hpp"
#include "mms/run/results/result_files.hpp"

namespace mms::python {

/// The last call may have come from another thread.
SlamSystem& LiveSlam::system() {
  if (!system_) system_.emplace(config_, std::move(segmenter_));
  system_->release_threads();
  return *system_;
}

FrameResult LiveSlam::process_locked(const Frame& frame) {
  if (!trajectory_.empty() && frame.stamp <= trajectory_.back().stamp) {
    throw std::invalid_argument("stamp: is " + std::to_string(frame.stamp.nanoseconds()) +
                                ", allowed: more than that of the frame before, " +
                                std::to_string(trajectory_.back().stamp.nanoseconds()));
  }
  if (!system_ && config_.measure_depth_noise) {
    config_.noise.depth = measured_noise(config_.noise.depth, frame.depth);
  }
  FrameResult result = system().process(frame);
  trajectory_.push_back({frame.stamp, result.odometry.T_world_sensor});
  objects_ = result.objects;
  has_image_ = has_image_ || result.cloud.organised();
  return result;
}

void LiveSlam::finish() {
  const std::scoped_lock lock(mutex_);
  system().finalize();
}

Trajectory LiveSlam::trajectory(bool corrected) {
  const std::scoped_lock lock(mutex_);
  Trajectory poses = trajectory_;
  if (!corrected) return poses;
  const PoseCorrection correction = system().global_map().correction();
  for (StampedPose& pose : poses) {
    const Transform<Global, Sensor> moved = correction.at(pose.stamp) * pose.T_world_sensor;
    if (!correction.empty()) pose.T_world_sensor = Transform<World, Sensor>(moved.isometry());
  }
  return poses;
}

MapCloud LiveSlam::static_map(bool corrected) {
  const std::scoped_lock lock(mutex_);
  const MapFrame frame = has_image_ ? MapFrame::kCamera : MapFrame::kLidar;
  const PoseCorrection correction =
      corrected ? system().global_map().correction() : PoseCorrection();
  if (correction.empty()) return result_map(system().static_map(), frame);
  return result_map(system().static_map(), frame,
                    [&](Timestamp stamp) { return correction.at(stamp).isometry(); });
}

std::vector<TrackedObject> LiveSlam::objects() {
  const std::scoped_lock lock(mutex_);
  return objects_;
}

}  // namespace mms::python
