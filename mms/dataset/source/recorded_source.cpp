#include "mms/dataset/source/recorded_source.hpp"

#include <algorithm>
#include <cstdio>

#include "mms/core/error.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/results/objects_io.hpp"

namespace mms {
namespace {

std::string decimals(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
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
  const Timestamp stamp = stamp_at(index);
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

std::vector<std::string> RecordedSource::describe() const {
  std::vector<std::string> lines = facts();
  lines.push_back("frames: " + std::to_string(size()));
  if (size() > 0) {
    const Timestamp first = stamp_at(0);
    const Timestamp last = stamp_at(size() - 1);
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
  const std::string clock = clock_fault();
  if (!clock.empty()) lines.push_back("warning: " + clock);
  if (std::filesystem::exists(map_truth_)) {
    lines.push_back("map truth: " + map_truth_.filename().string());
  }
  return lines;
}

std::string RecordedSource::clock_fault() const {
  if (ground_truth_.empty() || size() == 0) return "";
  const Timestamp first = stamp_at(0);
  const Timestamp last = stamp_at(size() - 1);
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
  for (const std::string& message : pending_warnings_) handler_(message);
  pending_warnings_.clear();
  const std::string clock = clock_fault();
  if (!clock.empty()) handler_(clock);
}

void RecordedSource::warn(const std::string& message) {
  if (handler_) {
    handler_(message);
  } else {
    pending_warnings_.push_back(message);
  }
}

}  // namespace mms
