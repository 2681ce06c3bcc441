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
#include "mms/pipeline/system_config.hpp"

namespace mms {

/// Journal of a run, from which trajectory and map of a killed run are recovered. A separate thread
/// encodes and writes, so that frames do not wait unless the disk is dozens of frames behind. If
/// the journal cannot be written, the run continues with a warning.
class RunJournal {
 public:
  using WarningHandler = std::function<void(const std::string&)>;

  /// Creates the journal in `folder`.
  /// @param data  input of the run, as the user gave it
  /// @param warn  called at most once, from either thread
  RunJournal(const std::filesystem::path& folder, const std::string& data,
             const SystemConfig& config, WarningHandler warn);

  /// Writes the queue; removes a journal without frames.
  ~RunJournal();
  RunJournal(const RunJournal&) = delete;
  RunJournal& operator=(const RunJournal&) = delete;

  /// Appends a frame.
  /// @param map  its changes of the static map; nullopt if it is not a keyframe
  void add(const Processed& processed, std::optional<MapChanges> map);

  /// Appends the changes of the map since the last keyframe, at the end of the run.
  void end(MapChanges map);

  /// Closes and removes the journal, whose content is in the run's files.
  void remove();

 private:
  void push(std::optional<MapChanges> map);
  void write_frames(const WarningHandler& warn);
  void finish();

  std::unique_ptr<JournalWriter> writer_;  // null if the journal could not be created
  BoundedQueue<std::unique_ptr<const JournalFrame>> queue_;
  std::thread thread_;
  std::optional<JournalFrame> last_;  // without its changes of the map
};

}  // namespace mms
