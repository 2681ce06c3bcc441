#include "mms/dataset/source/recorded_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/core/upper_median.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/results/objects_io.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/stamp_reader.hpp"

namespace mms {
namespace {

std::string decimals(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// A time since the first frame, as often.
Timestamp scaled(Timestamp stamp, double factor) {
  return Timestamp(std::llround(static_cast<double>(stamp.nanoseconds()) * factor));
}

}  // namespace

std::optional<Frame> RecordedSource::next() {
  while (position_ < size()) {
    const std::size_t index = position_++;
    if (auto frame = try_read(index)) return frame;
    ++skipped_;
  }
  return std::nullopt;
}

std::optional<Frame> RecordedSource::try_read(std::size_t index) {
  const Timestamp stamp = stamp_of(index);
  const std::string name = name_at(index);
  if (last_stamp_ && stamp <= *last_stamp_) {
    warn("frame " + name + " skipped: its stamp " + stamp.to_string() +
         " is not later than the previous one, " + last_stamp_->to_string());
    return std::nullopt;
  }
  try {
    Frame frame = read(index);
    frame.index = static_cast<std::int64_t>(index);
    frame.stamp = stamp;
    frame.name = name;
    motion_.attach(frame);
    last_stamp_ = stamp;
    return frame;
  } catch (const Error& error) {
    warn("frame " + name + " skipped: " + error.what());
    return std::nullopt;
  }
}

void RecordedSource::skip(std::size_t count) {
  passed_over_ = passed_over_ || count > 0;
  position_ += std::min(count, size() - std::min(position_, size()));
}

std::optional<TruthCloud> RecordedSource::map_truth() const {
  const bool all = position_ >= size() && !passed_over_;
  if (!all || map_truth_.empty() || !std::filesystem::exists(map_truth_)) return std::nullopt;
  PointCloudFile file = read_ply(map_truth_);
  remove_invalid_points(file);
  if (file.labels.empty() && !file.points.empty()) {
    throw DataError(map_truth_.string(), "has no property 'label'",
                    "expected a label per point: 0 static, else 1 + id of the object");
  }
  return TruthCloud{std::move(file.points), std::move(file.normals), std::move(file.colors),
                    std::move(file.labels)};
}

ObjectHistory RecordedSource::objects_truth() const {
  if (objects_truth_.empty() || !std::filesystem::exists(objects_truth_)) return {};
  return read_objects_truth(objects_truth_);
}

void RecordedSource::add_motion(MotionRecording motion) {
  motion_.add(std::move(motion.samples));
  motion_facts_.insert(motion_facts_.end(), motion.facts.begin(), motion.facts.end());
  for (const std::string& warning : motion.warnings) warn(warning);
}

bool RecordedSource::set_rate(double rate) {
  if (!assumed_rate_) return false;
  for (StampedPose& pose : ground_truth_) pose.stamp = scaled(pose.stamp, assumed_rate_->hz / rate);
  given_rate_ = rate;
  return true;
}

Timestamp RecordedSource::stamp_of(std::size_t index) const {
  const Timestamp stamp = stamp_at(index);
  return given_rate_ ? scaled(stamp, assumed_rate_->hz / *given_rate_) : stamp;
}

std::string RecordedSource::rate_fact() const {
  return "stamps: none, " + (given_rate_
                                 ? format_number(*given_rate_) + " Hz as given"
                                 : std::to_string(assumed_rate_->hz) + " Hz assumed (--rate)");
}

std::string RecordedSource::rate_fault() const {
  if (!assumed_rate_ || assumed_rate_->is_known || given_rate_) return "";
  return "the recording has no time stamps: " + std::to_string(assumed_rate_->hz) +
         " Hz is assumed; --rate gives the right one, if it is another";
}

std::string RecordedSource::step_fault() const {
  constexpr std::size_t kMinFrames = 5;  // fewer may be chosen by hand
  if (size() < kMinFrames) return "";
  std::vector<Duration> steps;
  for (std::size_t i = 1; i < size(); ++i) steps.push_back(stamp_of(i) - stamp_of(i - 1));
  const double step = to_seconds(upper_median(std::move(steps)));
  if (step <= kLongestImageStep) return "";
  return "the frames are " + decimals("%.0f s", step) +
         " apart, for a map at most 10 s: are the stamps in seconds, or in milli-, micro- or "
         "nanoseconds since 1970?";
}

std::vector<std::string> RecordedSource::describe() const {
  std::vector<std::string> lines = facts();
  if (assumed_rate_) lines.push_back(rate_fact());
  lines.push_back("frames: " + std::to_string(size()));
  if (size() > 0) {
    const Timestamp first = stamp_of(0);
    const Timestamp last = stamp_of(size() - 1);
    const double span = to_seconds(last - first);
    lines.push_back("time: " + first.to_string() + " to " + last.to_string() + " s, " +
                    decimals("%.3f s", span));
    if (span > 0.0) {
      const double intervals = static_cast<double>(size() - 1);
      lines.push_back("rate: " + decimals("%.2f Hz", intervals / span));
    }
  }
  lines.push_back("ground truth: " + (ground_truth_.empty()
                                          ? std::string("none")
                                          : std::to_string(ground_truth_.size()) + " poses"));
  lines.insert(lines.end(), motion_facts_.begin(), motion_facts_.end());
  for (const std::string& fault : {step_fault(), clock_fault()}) {
    if (!fault.empty()) lines.push_back("warning: " + fault);
  }
  if (std::filesystem::exists(map_truth_)) {
    lines.push_back("map truth: " + map_truth_.filename().string());
  }
  return lines;
}

std::string RecordedSource::clock_fault() const {
  if (ground_truth_.empty() || size() == 0) return "";
  const Timestamp first = stamp_of(0);
  const Timestamp last = stamp_of(size() - 1);
  const Timestamp truth_first = ground_truth_.front().stamp;
  const Timestamp truth_last = ground_truth_.back().stamp;
  if (truth_first <= last && first <= truth_last) return "";
  return "the ground truth is from " + truth_first.to_string() + " to " + truth_last.to_string() +
         " s, the recording from " + first.to_string() + " to " + last.to_string() +
         " s: they have different clocks, so no pose can be compared";
}

void RecordedSource::on_warning(WarningHandler handler) {
  handler_ = std::move(handler);
  if (!handler_) return;
  for (const std::string& message : std::exchange(pending_warnings_, {})) handler_(message);
  if (std::exchange(has_told_faults_, true)) return;
  for (const std::string& fault : {rate_fault(), step_fault(), clock_fault()}) {
    if (!fault.empty()) handler_(fault);
  }
}

void RecordedSource::warn(const std::string& message) {
  if (handler_) {
    handler_(message);
  } else {
    pending_warnings_.push_back(message);
  }
}

}  // namespace mms
