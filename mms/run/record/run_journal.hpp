#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "mms/core/bounded_queue.hpp"
#include "mms/io/journal/journal.hpp"
#include "mms/io/journal/journal_writer.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/pipeline/config.hpp"

namespace mms {

/// The journal of a run: what a killed run leaves of its trajectory and map. A thread of its own
/// encodes and writes, so that a frame waits for neither, except where the disk is behind by
/// dozens of frames. A journal that cannot be written costs one warning, not the run.
class RunJournal {
 public:
  using WarningHandler = std::function<void(const std::string&)>;

  /// Begins the journal of `folder`. @param data  what is run, in the user's words
  /// @param warn  called once at most, from either thread
  RunJournal(const std::filesystem::path& folder, const std::string& data,
             const SystemConfig& config, WarningHandler warn);

  /// Writes what is in the queue; removes a journal without frames.
  ~RunJournal();
  RunJournal(const RunJournal&) = delete;
  RunJournal& operator=(const RunJournal&) = delete;

  /// Takes a frame down. @param map  what it did to the static map; nothing where it is no keyframe
  void add(const Processed& processed, std::optional<MapChanges> map);

  /// Takes down what the frames since the last keyframe did to the map: the run is at its end.
  void end(MapChanges map);

  /// Ends the journal and removes it: what it holds is in the run's files.
  void remove();

 private:
  void push(std::optional<MapChanges> map);
  void write_frames(WarningHandler warn);
  void finish();

  std::filesystem::path path_;
  std::unique_ptr<JournalWriter> writer_;  // null where the journal could not be begun
  BoundedQueue<std::unique_ptr<const JournalFrame>> queue_;
  std::thread thread_;
  std::optional<JournalFrame> last_;  // without what it did to the map
};

}  // namespace mms
