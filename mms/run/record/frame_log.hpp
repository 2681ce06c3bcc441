#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "mms/core/object_box.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/io/text/disk_buffer.hpp"
#include "mms/pipeline/frame_result.hpp"

namespace mms {

/// Data kept of every frame of a run.
struct LoggedFrame {
  Timestamp stamp;
  std::int64_t index = 0;     ///< in the recording
  std::uint32_t session = 0;  ///< of the run, see `FrameResult`
  Transform<World, Sensor> T_world_sensor;
  Status status = Status::kInitialized;
  bool keyframe = false;
  bool relocalized = false;
  bool is_searching = false;  ///< lost, and its place is searched for
  bool in_map = false;        ///< whether its place in the map was known then
  double dynamic_share = 0.0;
  double overruled_share = 0.0;
  int implausible_masks = 0;
  double read_ms = 0.0;
  double interval_ms = 0.0;  ///< wall time since the end of the previous frame
  StageTimes stage_ms{};
  std::optional<double> latency_ms;  ///< of live sensors and in real-time mode

  double stages_ms() const;  ///< sum of reading and all stages
};

/// The frames of a run so far, on disk, so that a long run does not fill the memory.
class FrameLog {
 public:
  /// @param folder  for temporary files; empty: all stays in memory
  explicit FrameLog(const std::filesystem::path& folder) : frames_(folder) {}

  void add(const LoggedFrame& frame);

  std::size_t size() const { return size_; }
  const LoggedFrame& first() const { return first_; }  ///< with the default values before `add`
  const LoggedFrame& last() const { return last_; }    ///< the same

  /// All frames. @throws FileError if they cannot be read
  std::vector<LoggedFrame> read() const;

 private:
  DiskBuffer frames_;
  std::size_t size_ = 0;
  LoggedFrame first_;
  LoggedFrame last_;
};

/// The objects of a run's frames so far, on disk.
class ObjectLog {
 public:
  /// @param folder  as that of `FrameLog`
  explicit ObjectLog(const std::filesystem::path& folder) : objects_(folder) {}

  void add(const ObjectFrame& frame);

  /// All frames. @throws FileError if they cannot be read
  ObjectHistory read() const;

 private:
  DiskBuffer objects_;
  std::size_t size_ = 0;
};

}  // namespace mms
