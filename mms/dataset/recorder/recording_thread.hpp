#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "mms/core/bounded_queue.hpp"
#include "mms/dataset/recorder/frame_recorder.hpp"

namespace mms {

/// Writes the frames of a live sensor in a thread of its own, so that the sensor does not wait.
/// Frames that find no room, as on a slow disk, are left out. If writing fails, there is a warning,
/// and the recording ends with the frames before.
class RecordingThread {
 public:
  /// Receives a line, in any thread.
  using WarningHandler = std::function<void(const std::string&)>;

  RecordingThread(std::unique_ptr<FrameRecorder> recorder, WarningHandler warn);
  /// As `finish`.
  ~RecordingThread() { finish(); }
  RecordingThread(const RecordingThread&) = delete;
  RecordingThread& operator=(const RecordingThread&) = delete;

  /// Does not wait.
  void add(const Frame& frame);

  /// Writes what is waiting, and the files of the whole recording. Warns of what was left out.
  void finish();

 private:
  void write_all();

  std::unique_ptr<FrameRecorder> recorder_;
  WarningHandler warn_;
  BoundedQueue<Frame> queue_;
  std::atomic<bool> failed_ = false;
  std::size_t left_out_ = 0;  ///< of the thread that adds
  std::thread thread_;
};

}  // namespace mms
