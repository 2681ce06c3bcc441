#include "apps/mms/console/progress.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "apps/mms/console/duration_text.hpp"
#include "mms/dataset/source/frame_source.hpp"

namespace mms {
namespace {

std::string count_text(std::size_t count, const char* one, const char* many) {
  return fmt::format("  {} {}", count, count == 1 ? one : many);
}

/// The objects in view: "  2 people  1 vehicle".
std::string objects_text(const std::vector<ObjectBox>& objects) {
  const auto number_of = [&](ObjectClass object_class) {
    return static_cast<std::size_t>(std::count_if(
        objects.begin(), objects.end(),
        [&](const ObjectBox& object) { return object.object_class == object_class; }));
  };
  std::string text = count_text(number_of(ObjectClass::kPerson), "person", "people");
  const std::size_t vehicles = number_of(ObjectClass::kAgv);
  if (vehicles > 0) text += count_text(vehicles, "vehicle", "vehicles");
  const std::size_t others = number_of(ObjectClass::kUnknown);
  if (others > 0) text += count_text(others, "other", "others");
  return text;
}

}  // namespace

void Progress::on_start(const std::vector<std::string>& heading, std::size_t frames) {
  total_ = frames;
  start_ = Clock::now();
  if (quiet_) return;
  for (const std::string& line : heading) status_.say(line);
}

void Progress::on_frame(const RunLog& log) {
  if (!quiet_ && status_.due(log.size() >= total_)) status_.show(line(log));
}

void Progress::on_warning(const std::string& message) {
  if (warnings_.add(message)) status_.warn(message);
}

void Progress::on_end() {
  status_.finish();
  for (const std::string& line : warnings_.rest()) status_.warn(line);
}

std::string Progress::line(const RunLog& log) const {
  const std::chrono::duration<double> elapsed = Clock::now() - start_;
  const std::size_t done = log.size();
  const double rate = static_cast<double>(done) / elapsed.count();
  if (total_ == FrameSource::kEndless) {
    const auto& latency = log.last().latency_ms;
    return fmt::format("frame {}  {:.1f} Hz  {}{}  {}", done, rate,
                       latency ? fmt::format("latency {:.0f} ms  ", *latency) : "",
                       to_string(log.last().status), objects_text(log.objects_now()));
  }
  return fmt::format("frame {}/{}  {:.1f} Hz  {} left  {}{}", done, total_, rate,
                     duration_text(static_cast<double>(total_ - done) / rate),
                     to_string(log.last().status), objects_text(log.objects_now()));
}

}  // namespace mms
