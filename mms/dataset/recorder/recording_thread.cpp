#include "mms/dataset/recorder/recording_thread.hpp"

#include <optional>
#include <utility>

namespace mms {
namespace {

constexpr std::size_t kMaxUnwritten = 150;  // frames: 5 s, 0.3 GB at 640x480

}  // namespace

RecordingThread::RecordingThread(std::unique_ptr<FrameRecorder> recorder, WarningHandler warn)
    : recorder_(std::move(recorder)),
      warn_(std::move(warn)),
      queue_(kMaxUnwritten),
      thread_([this] { write_all(); }) {}

void RecordingThread::add(const Frame& frame) {
  if (failed_ || queue_.try_push(frame)) return;
  if (left_out_++ == 0) warn_("recording: frames are left out, the disk is too slow");
}

void RecordingThread::finish() {
  if (!thread_.joinable()) return;
  queue_.close();
  thread_.join();
  if (left_out_ > 0) {
    warn_("recording: " + std::to_string(left_out_) + " frames are left out");
  }
}

void RecordingThread::write_all() {
  bool any = false;
  try {
    while (std::optional<Frame> frame = queue_.pop()) {
      recorder_->add(*frame);
      any = true;
    }
  } catch (const std::exception& error) {
    failed_ = true;
    queue_.close();
    warn_(std::string("recording ended: ") + error.what());
  }
  try {
    if (any) recorder_->finish({});
  } catch (const std::exception& error) {
    warn_(std::string("recording cannot be completed: ") + error.what());
  }
}

}  // namespace mms
