#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "mms/dataset/plausibility/recording_check.hpp"
#include "mms/dataset/source/frame_source.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/run/record/run_journal.hpp"
#include "mms/run/record/run_log.hpp"
#include "mms/run/record/run_options.hpp"
#include "mms/run/record/run_recorder.hpp"
#include "mms/run/repeated_frames.hpp"
#include "mms/run/repeated_warnings.hpp"
#include "mms/run/results/run_map.hpp"
#include "mms/run/run_observer.hpp"
#include "mms/run/view/live_view.hpp"

namespace mms {

/// One run of the system over a recording, from arguments to results.
class SlamRun {
 public:
  /// Opens the recording and creates the system.
  /// @throws Error on failure.
  explicit SlamRun(const RunOptions& options);

  /// The same on another source, in place of the recording that the options name.
  SlamRun(const RunOptions& options, std::unique_ptr<FrameSource> source);

  /// Receives every frame with its results, and the static map as of that frame, in the thread of
  /// the run. To be set before `play`.
  using ResultSink = std::function<void(const Processed& processed, const SlamSystem& system)>;
  void on_result(ResultSink sink) { sink_ = std::move(sink); }

  /// Processes the recording with a journal in `folder`, and compares the results with available
  /// ground truth. If the observer ends it early, the frames so far count.
  /// @throws DataError if no frame was processed.
  void play(const std::filesystem::path& folder, RunObserver& observer);

  /// Writes all files of the run and closes the journal.
  void write(const std::filesystem::path& folder);

  /// Writes the map file, if one was asked for. After `play`.
  /// @returns whether it was written
  /// @throws FileError if it cannot be; an earlier map is as before then
  bool save_map(RunObserver& observer);

  /// The viewer of the run; null without `RunOptions::view`.
  LiveView* view() const { return view_.get(); }

  /// Why the run ended before the recording did, where nearly all frames were lost; else empty.
  const std::string& failure() const { return failure_; }

  /// Whether the observer ended the run early.
  bool interrupted() const { return interrupted_; }

  const RunLog& log() const { return *log_; }
  const SlamSystem& system() const { return system_; }
  const RunOptions& options() const { return options_; }

 private:
  void warm_up();
  void process(const std::filesystem::path& folder, RunObserver& observer);
  void compare_with_truth(RunObserver& observer);
  void warn(const std::string& message, RunObserver& observer);
  bool is_repeated(Frame& frame, RunObserver& observer);
  void check_plausibility(const Frame& frame, RunObserver& observer);
  void report_implausible(RunObserver& observer);
  void check_lost();
  AsyncPipeline::Source frames_for(RunObserver& observer);
  void finish_frame(Processed processed, RunObserver& observer);
  void end_map();
  void finish_recording();
  void warn_of_losses(const Processed& processed, RunObserver& observer);
  void warn_of_sessions_outside(RunObserver& observer);
  void warn_if_not_localized(RunObserver& observer);
  void warn_of_other_axes(RunObserver& observer);

  RunOptions options_;
  std::unique_ptr<FrameSource> source_;
  std::vector<std::string> warnings_;  // of the settings, then of the run
  RepeatedWarnings repeated_warnings_;
  std::mutex warnings_mutex_;
  std::optional<Frame> first_;  // read for the settings, null once processed
  std::size_t stale_ = 0;       // frames that arrived before a run in real time
  RepeatedFrames repeated_;     // of the reading thread
  SystemConfig config_;
  SlamSystem system_;
  RunMap map_;
  std::size_t frames_ = 0;  // to be processed at most
  std::unique_ptr<RunLog> log_;
  std::unique_ptr<RunJournal> journal_;
  std::unique_ptr<RunRecorder> recorder_;  // null without --mcap
  std::unique_ptr<LiveView> view_;         // null without --view
  ResultSink sink_;
  bool interrupted_ = false;
  std::optional<RecordingCheck> check_;  // null after its report
  std::size_t lost_ = 0;                 // frames
  std::atomic<bool> gave_up_ = false;    // read by the reading thread
  std::string failure_;
  std::uint32_t session_ = 0;  // of the last frame
  bool is_outside_ = false;    // whether the place of a session after a loss is unknown
};

}  // namespace mms
