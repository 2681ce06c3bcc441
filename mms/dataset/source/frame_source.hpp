#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/object_box.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/dataset/source/motion_files.hpp"
#include "mms/simulation/truth/truth_cloud.hpp"

namespace mms {

/// A recording as a sequence of frames. `next` skips damaged frames, reports them to the warning
/// handler and counts them.
class FrameSource {
 public:
  /// Receives one line with file and fault.
  using WarningHandler = std::function<void(const std::string&)>;

  /// Size of a source without end, as for a sensor.
  static constexpr std::size_t kEndless = std::numeric_limits<std::size_t>::max();

  virtual ~FrameSource() = default;

  /// The next readable frame; nullopt at the end of the recording.
  virtual std::optional<Frame> next() = 0;

  /// Number of frames in the recording, including damaged ones; kEndless if there is no end.
  virtual std::size_t size() const = 0;

  /// Frames skipped so far because they could not be read.
  virtual std::size_t skipped() const = 0;

  /// Frames of a live source that were lost so far because they were not taken in time.
  virtual std::size_t dropped() const { return 0; }

  /// When the last frame of `next` arrived; nullopt if it is of a recording.
  virtual std::optional<std::chrono::steady_clock::time_point> arrival() const {
    return std::nullopt;
  }

  /// Skips the next `count` frames without reading them.
  virtual void skip(std::size_t count) = 0;

  /// Whether any frame has a mask.
  virtual bool has_masks() const = 0;

  /// Calibration known before the first frame; null if unknown.
  virtual std::shared_ptr<const Calibration> calibration() const { return nullptr; }

  /// Ground-truth poses in the recording's world frame; empty if unknown.
  virtual const Trajectory& ground_truth() const = 0;

  /// Ground-truth map of the frames returned so far, static and dynamic, in the world frame of the
  /// ground-truth poses; nullopt if unknown. A recording only has the map of all its frames, so it
  /// returns nullopt before the end and after skipped frames.
  /// @throws Error if the file cannot be read.
  virtual std::optional<TruthCloud> map_truth() const { return std::nullopt; }

  /// Ground-truth objects of the frames returned so far, in the world frame of the ground-truth
  /// poses; empty if unknown.
  /// @throws Error if the file cannot be read.
  virtual ObjectHistory objects_truth() const { return {}; }

  /// Adds measurements of wheels or gyroscope, which frames bring from then on. They replace
  /// earlier ones of the same kind.
  virtual void add_motion(MotionRecording motion) = 0;

  /// Sets the frames a second of a recording without time stamps, before its first frame.
  /// @param rate  [Hz], > 0
  /// @returns whether it has none; else nothing is changed
  virtual bool set_rate([[maybe_unused]] double rate) { return false; }

  /// Facts about the recording, one per line, for `mms info`.
  virtual std::vector<std::string> describe() const = 0;

  /// Sets the handler for skipped frames; none by default.
  virtual void on_warning(WarningHandler handler) = 0;
};

}  // namespace mms
