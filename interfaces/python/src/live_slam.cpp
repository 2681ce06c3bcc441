#include "interfaces/python/src/live_slam.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "mms/dataset/source/motion_files.hpp"
#include "mms/geometry/noise_measurement.hpp"
#include "mms/run/results/result_files.hpp"
#include "mms/run/results/robot_maps.hpp"

namespace mms::python {
namespace {

/// @param last  stamp of the last sample so far
template <class Sample>
void check_order(const std::vector<Sample>& samples, std::optional<Timestamp> last) {
  for (const Sample& sample : samples) {
    if (last && sample.stamp < *last) {
      throw std::invalid_argument("stamps: has " + std::to_string(sample.stamp.nanoseconds()) +
                                  ", allowed: not less than that before, " +
                                  std::to_string(last->nanoseconds()));
    }
    last = sample.stamp;
  }
}

template <class Sample>
void add_later(const std::vector<Sample>& samples, std::optional<Timestamp>& last,
               std::vector<Sample>& all) {
  for (const Sample& sample : samples) {
    if (last == sample.stamp) continue;
    all.push_back(sample);
    last = sample.stamp;
  }
}

/// Moves the samples up to a time out of all.
template <class Sample>
std::vector<Sample> take_until(std::vector<Sample>& all, Timestamp end) {
  const auto rest = std::find_if(all.begin(), all.end(),
                                 [end](const Sample& sample) { return sample.stamp > end; });
  std::vector<Sample> taken(all.begin(), rest);
  all.erase(all.begin(), rest);
  return taken;
}

}  // namespace

/// Made with the first frame, whose noise and calibration it needs.
SlamSystem& LiveSlam::make_system(const Calibration* calibration) {
  if (!system_ && takes_max_depth_ && calibration != nullptr && calibration->max_depth) {
    config_.static_map.surface.max_depth = *calibration->max_depth;
  }
  if (!system_) {
    system_.emplace(config_, std::move(segmenter_));
    map_.set_settings(config_);
  }
  if (!std::exchange(has_map_, true)) {
    try {
      map_.load(*system_, calibration, [this](const std::string& line) { warn(line); });
    } catch (...) {
      has_map_ = false;  // the next call fails, too
      throw;
    }
  }
  return *system();
}

/// The last call may have come from another thread.
SlamSystem* LiveSlam::system() {
  if (!system_) return nullptr;
  system_->release_threads();
  return &*system_;
}

void LiveSlam::check_stamp(const Frame& frame) const {
  if (!trajectory_.empty() && frame.stamp <= trajectory_.back().stamp) {
    throw std::invalid_argument("stamp: is " + std::to_string(frame.stamp.nanoseconds()) +
                                ", allowed: more than that of the frame before, " +
                                std::to_string(trajectory_.back().stamp.nanoseconds()));
  }
}

void LiveSlam::attach_motion(Frame& frame) {
  const Timestamp end = motion_end(frame);
  frame.motion.wheels = take_until(motion_.wheels, end);
  frame.motion.imu = take_until(motion_.imu, end);
}

void LiveSlam::add_motion(const MotionSamples& samples) {
  const std::scoped_lock lock(mutex_);
  check_order(samples.wheels, last_wheels_);
  check_order(samples.imu, last_imu_);
  add_later(samples.wheels, last_wheels_, motion_.wheels);
  add_later(samples.imu, last_imu_, motion_.imu);
}

void LiveSlam::expect_place(const Transform<Global, Sensor>& T_global_sensor) {
  const std::scoped_lock lock(mutex_);
  expected_place_ = T_global_sensor;
}

FrameResult LiveSlam::process_locked(const Frame& frame) {
  check_stamp(frame);
  if (!system_ && config_.measure_depth_noise) {
    config_.noise.depth = measured_noise(config_.noise.depth, frame.depth);
  }
  FrameResult result = make_system(frame.calibration.get()).process(frame);
  map_.add(result);
  trajectory_.push_back({frame.stamp, result.odometry.T_world_sensor});
  frames_.push_back({result.session, result.is_searching()});
  objects_ = result.objects;
  has_image_ = has_image_ || result.cloud.organised();
  return result;
}

void LiveSlam::finish() {
  const std::scoped_lock lock(mutex_);
  if (SlamSystem* const present = system()) present->finalize();
}

bool LiveSlam::save_map() {
  const std::scoped_lock lock(mutex_);
  if (trajectory_.empty()) throw std::runtime_error("save_map: no frame was processed");
  return map_.save(*system(), [this](const std::string& line) { warn(line); });
}

std::vector<std::string> LiveSlam::take_warnings() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(warnings_, {});
}

Trajectory LiveSlam::trajectory(bool corrected) {
  const std::scoped_lock lock(mutex_);
  const SlamSystem* const present = system();
  if (!corrected || present == nullptr) return trajectory_;
  const std::vector<SessionPlace> places = session_places(present->global_map(), session_count());
  Trajectory poses;
  for (std::size_t i = 0; i < trajectory_.size(); ++i) {
    const auto& [stamp, T_world_sensor] = trajectory_[i];
    const auto pose = places[frames_[i].session].corrected(stamp, T_world_sensor);
    if (pose && !frames_[i].is_searching) poses.push_back({stamp, *pose});
  }
  return poses;
}

MapCloud LiveSlam::static_map(bool corrected) {
  const std::scoped_lock lock(mutex_);
  const SlamSystem* const present = system();
  if (present == nullptr) return {};
  const MapFrame frame = has_image_ ? MapFrame::kCamera : MapFrame::kLidar;
  if (!corrected) return result_map(present->static_map(), frame);
  const std::vector<SessionPlace> places = session_places(present->global_map(), session_count());
  return result_map(present->mapping(), frame, places);
}

OccupancyGrid LiveSlam::occupancy_grid(bool corrected) {
  const std::scoped_lock lock(mutex_);
  if (!config_.occupancy.enabled) {
    throw std::runtime_error("occupancy_grid: occupancy.enabled is off in the settings");
  }
  const SlamSystem* const present = system();
  if (present == nullptr) return {};
  const std::vector<SessionPlace> places = session_places(present->global_map(), session_count());
  RobotMaps maps =
      corrected && are_corrected(places)
          ? make_robot_maps(map_occupancy(present->global_map(), session_count(), config_),
                            joined_map(present->mapping().session_maps(), places), has_image_,
                            MapMarking::kObstacles)
          : make_robot_maps(present->occupancy_map(), present->static_map().cloud(), has_image_);
  if (!maps.warning.empty()) warn(maps.warning);
  return std::move(maps.grid);
}

std::vector<TrackedObject> LiveSlam::objects() {
  const std::scoped_lock lock(mutex_);
  return objects_;
}

}  // namespace mms::python
