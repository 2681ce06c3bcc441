#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "mms/core/bounded_queue.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/mapping/static_map/static_map.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/result_messages/result_messages.hpp"
#include "mms/ros/storage/bag_writer.hpp"

namespace mms {

/// Name in the result folder.
inline constexpr const char* kRecordingName = "run.mcap";

/// Records the results of a run as ROS 2 messages in an MCAP file, for Foxglove, RViz and other
/// viewers. A thread of its own draws, compresses and writes; the run waits for it only while its
/// queue is full. If writing fails (disk full), there is a warning and no file, and the run goes
/// on.
class RunRecorder {
 public:
  using WarningHandler = std::function<void(const std::string&)>;

  /// @param warn  called in the thread of the recorder, or in the constructor
  RunRecorder(const std::filesystem::path& folder, WarningHandler warn);

  /// Without `finish`, there is no file.
  ~RunRecorder();
  RunRecorder(const RunRecorder&) = delete;
  RunRecorder& operator=(const RunRecorder&) = delete;

  /// Adds a frame, and the map whenever it has grown by a tenth.
  /// @param map  as of that frame
  void add(const Processed& processed, const StaticMap& map);

  /// Adds the final map and paths, and completes the file.
  /// @param corrected  empty without loops
  void finish(MapCloud map, Trajectory corrected);

 private:
  struct Entry {
    Timestamp stamp;
    std::uint32_t index = 0;
    std::optional<FrameResult> result;
    std::optional<MapCloud> map;
    double read_ms = 0.0;
    Trajectory corrected;  ///< in the frame of the map, and with it the map
  };

  void write_entries();
  void write(const Entry& entry);
  void write_frame(const Entry& entry, const FrameResult& result);
  void write_end(const Entry& entry);
  void write_path(const std::string& topic, const msg::Header& header, const Trajectory& poses);
  msg::Header header_of(const Entry& entry, const std::string& frame_id) const;

  WarningHandler warn_;
  std::unique_ptr<BagWriter> file_;  ///< null after a fault
  BoundedQueue<std::unique_ptr<const Entry>> queue_;
  Timestamp last_;                   ///< stamp of the last frame
  std::size_t recorded_points_ = 0;  ///< of the last map in the file
  // Of the thread:
  FrameNames frames_{"map", "world", {}};
  bool is_camera_ = false;
  Trajectory path_;
  std::size_t recorded_poses_ = 0;  ///< of the last path in the file
  std::thread thread_;
};

}  // namespace mms
