#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/motion_samples.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/geometry/voxels/occupancy.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/run/results/run_map.hpp"

namespace mms::python {

/// A SlamSystem for callers in any thread, which take turns. Before the first frame there is none,
/// and all results are empty. Knows nothing of Python.
class LiveSlam {
 public:
  /// @param takes_max_depth  whether the calibration of the first frame replaces the largest depth
  /// @throws Error for map files that cannot be read or written
  LiveSlam(const SystemConfig& config, std::unique_ptr<Segmenter> segmenter,
           const MapFileOptions& map, bool takes_max_depth)
      : config_(config),
        takes_max_depth_(takes_max_depth),
        segmenter_(std::move(segmenter)),
        map_(map, config) {}

  /// Localizes the frame that `fill` makes of the last one, whose memory is used again.
  /// @throws std::invalid_argument for a stamp that is not later than that before
  template <class Fill>
  FrameResult fill_and_process(const Fill& fill) {
    const std::scoped_lock lock(mutex_);
    fill(frame_);
    check_stamp(frame_);
    attach_motion(frame_);
    frame_.expected_place = std::exchange(expected_place_, std::nullopt);
    return process_locked(frame_);
  }

  /// Localizes a frame, without a copy.
  FrameResult process(const Frame& frame) {
    const std::scoped_lock lock(mutex_);
    return process_locked(frame);
  }

  /// Adds measurements for the frames of `fill_and_process` that follow. Those that repeat a stamp
  /// are left out.
  /// @throws std::invalid_argument for a stamp that is less than that before
  void add_motion(const MotionSamples& samples);

  /// Searches the place in the map around a given one from the next frame of `fill_and_process` on.
  void expect_place(const Transform<Global, Sensor>& T_global_sensor);

  /// Completes the maps after the last frame. Does nothing before the first one.
  void finish();

  /// All poses so far.
  /// @param corrected  by loop closure, in the frame of the map; without frames whose place in
  /// it is not known
  Trajectory trajectory(bool corrected);

  /// The static map of the present session; of a LiDAR with a normal for every point.
  /// @param corrected  by loop closure, with all sessions whose place is known, as result files
  MapCloud static_map(bool corrected);

  /// The floor as result files have it; empty before the first frame.
  /// @param corrected  by loop closure, as `static_map`
  /// @throws std::runtime_error where the settings have no occupancy map
  OccupancyGrid occupancy_grid(bool corrected);

  /// Writes the map file, once.
  /// @returns whether one was asked for, and had a keyframe
  bool save_map();

  /// Warnings since the last call.
  std::vector<std::string> take_warnings();

  /// The objects of the last frame.
  std::vector<TrackedObject> objects();

 private:
  void check_stamp(const Frame& frame) const;
  void attach_motion(Frame& frame);
  FrameResult process_locked(const Frame& frame);
  SlamSystem& make_system(const Calibration* calibration);
  SlamSystem* system();
  void warn(const std::string& line) { warnings_.push_back(line); }
  std::uint32_t session_count() const { return frames_.empty() ? 1U : frames_.back().session + 1U; }

  std::mutex mutex_;
  SystemConfig config_;
  bool takes_max_depth_;
  std::unique_ptr<Segmenter> segmenter_;  ///< null once there is a system
  std::optional<SlamSystem> system_;      ///< made with the first frame
  RunMap map_;
  bool has_map_ = false;  ///< whether the earlier map, if any, was given to the system
  std::vector<std::string> warnings_;
  Frame frame_;
  MotionSamples motion_;  ///< since that of `frame_`
  std::optional<Timestamp> last_wheels_;
  std::optional<Timestamp> last_imu_;
  std::optional<Transform<Global, Sensor>> expected_place_;  ///< of the next frame
  Trajectory trajectory_;
  struct LocalizedFrame {
    std::uint32_t session = 0;
    bool is_searching = false;  ///< see `FrameResult`
  };
  std::vector<LocalizedFrame> frames_;  ///< of the poses of the trajectory
  std::vector<TrackedObject> objects_;
  bool has_image_ = false;
};

}  // namespace mms::python
