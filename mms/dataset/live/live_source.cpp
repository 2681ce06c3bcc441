#include "mms/dataset/live/live_source.hpp"

#include <utility>

namespace mms {

bool LiveSource::wait(WarningHandler report) {
  on_warning(std::move(report));
  first_ = queue_.pop();
  if (first_) calibration_ = registered_calibration(first_->calibration);
  return first_.has_value();
}

std::optional<Frame> LiveSource::next() {
  std::optional<Frame> frame = first_ ? std::exchange(first_, std::nullopt) : queue_.pop();
  if (frame && frame->calibration->depth_camera) register_depth(*frame);
  return frame;
}

void LiveSource::register_depth(Frame& frame) {
  if (raw_calibration_ != frame.calibration) {
    raw_calibration_ = frame.calibration;
    registration_ = make_registration(*raw_calibration_);
    calibration_ = registered_calibration(raw_calibration_);
  }
  frame.depth = registration_->apply(frame.depth);
  frame.calibration = calibration_;
}

void LiveSource::skip(std::size_t count) {
  while (count > 0 && next()) --count;
}

void LiveSource::on_warning(WarningHandler handler) {
  const std::scoped_lock lock(handler_mutex_);
  handler_ = std::move(handler);
  if (!handler_) return;
  for (const std::string& message : std::exchange(unheard_, {})) handler_(message);
}

void LiveSource::warn(const std::string& message) {
  constexpr std::size_t kMaxUnheard = 20;
  const std::scoped_lock lock(handler_mutex_);
  if (handler_) return handler_(message);
  if (unheard_.size() < kMaxUnheard) unheard_.push_back(message);
}

void LiveSource::push(Frame frame) {
  queue_.push(std::move(frame));
  if (said_dropped_ || queue_.dropped() == 0) return;
  said_dropped_ = true;
  warn(
      "frames are dropped: the run is slower than the sensor (--realtime keeps the latency small)");
}

}  // namespace mms
