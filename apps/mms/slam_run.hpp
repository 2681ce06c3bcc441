#pragma once

#include <filesystem>
#include <memory>

#include "live_view.hpp"
#include "mms/dataset/frame_source.hpp"
#include "mms/pipeline/config.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "progress.hpp"
#include "run_journal.hpp"
#include "run_log.hpp"
#include "run_options.hpp"

namespace mms {

/// One run of the system over a recording, from the words of the command line to its results.
class SlamRun {
 public:
  /// Opens the recording and makes the system. @throws Error when that cannot be done.
  explicit SlamRun(const RunOptions& options);

  /// Plays the recording, with progress on stderr, keeping a journal in `folder` meanwhile, and
  /// compares the results with the truth that is there. After a signal what is done so far counts.
  /// @throws DataError when no frame could be processed.
  void play(const std::filesystem::path& folder);

  /// Writes all files of the run; the journal ends.
  void write(const std::filesystem::path& folder);

  /// Lets viewers know where the files are. Where a person is at the terminal, goes on to show the
  /// run until Ctrl-C; a script goes on at once.
  void keep_showing(const std::filesystem::path& folder);

  const RunLog& log() const { return *log_; }
  const SlamSystem& system() const { return system_; }
  const RunOptions& options() const { return options_; }

 private:
  void warm_up();
  void process(const std::filesystem::path& folder);
  void compare_with_truth();
  void finish_frame(Processed processed);
  void end_map();

  RunOptions options_;
  std::unique_ptr<FrameSource> source_;
  SystemConfig config_;
  SlamSystem system_;
  Progress progress_;
  std::unique_ptr<RunLog> log_;
  std::unique_ptr<RunJournal> journal_;
  std::unique_ptr<LiveView> view_;  // null without --view
  bool interrupted_ = false;
};

}  // namespace mms
