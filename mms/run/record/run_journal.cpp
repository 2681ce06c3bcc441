#include "mms/run/record/run_journal.hpp"

#include <chrono>
#include <exception>
#include <utility>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr std::size_t kQueueCapacity = 64;  // frames, several seconds

Timestamp wall_clock() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return Timestamp(std::chrono::duration_cast<Duration>(now).count());
}

void warn_of(const std::exception& error, const RunJournal::WarningHandler& warn) {
  warn(std::string(error.what()) + "; the run continues, but cannot be recovered if it is killed");
}

}  // namespace

RunJournal::RunJournal(const std::filesystem::path& folder, const std::string& data,
                       const SystemConfig& config, WarningHandler warn)
    : queue_(kQueueCapacity) {
  try {
    writer_ = std::make_unique<JournalWriter>(
        folder / kJournalName,
        JournalHeader{data, config.static_map.voxel_size, config.static_map.min_observations});
  } catch (const Error& error) {
    warn_of(error, warn);
    return;
  }
  thread_ = std::thread([this, warn = std::move(warn)] { write_frames(warn); });
}

RunJournal::~RunJournal() {
  last_ ? finish() : remove();
}

void RunJournal::add(const Processed& processed, std::optional<MapChanges> map) {
  const FrameResult& result = processed.result;
  last_ = {processed.frame.stamp,
           wall_clock(),
           result.odometry.T_world_sensor,
           result.odometry.status,
           result.keyframe,
           result.cloud.organised(),
           std::nullopt};
  push(std::move(map));
}

void RunJournal::end(MapChanges map) {
  if (!last_) return;
  last_->written = wall_clock();
  push(std::move(map));
}

void RunJournal::push(std::optional<MapChanges> map) {
  if (!writer_) return;
  auto frame = std::make_unique<JournalFrame>(*last_);
  frame->map = std::move(map);
  queue_.push(std::move(frame));
}

void RunJournal::write_frames(const WarningHandler& warn) {
  try {
    while (const auto frame = queue_.pop()) writer_->append(**frame);
  } catch (const std::exception& error) {  // including lack of memory
    queue_.close();
    warn_of(error, warn);
  }
}

void RunJournal::finish() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

void RunJournal::remove() {
  finish();
  if (writer_) writer_->remove();
}

}  // namespace mms
