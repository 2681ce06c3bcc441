#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <memory>
#include <string>

#include "mms/dataset/live/live_source.hpp"
#include "mms/run/slam_run.hpp"

namespace mms {

// What mms run, with recordings or cameras, and mms ros2 have in common.

/// What a run prints.
struct ConsoleOptions {
  bool quiet = false;
  bool json = false;
  /// Whether another run follows, whose viewer takes the place of this one's; empty: none.
  std::function<bool()> continues{};
};

/// The word after --view.
struct ViewChoice {
  std::string word;  ///< a port; empty: as `place`
  ViewOptions place;
};

/// Adds --config, --set, --output and --overwrite.
void add_result_options(CLI::App& command, RunOptions& options);

/// Adds --fusion, --loops, --save-map, --map and --localize.
void add_mapping_options(CLI::App& command, RunOptions& options);

/// Adds --threads, --keep-journal and --mcap.
void add_recording_options(CLI::App& command, RunOptions& options);

/// Adds --quiet, --json, --view and --bind.
void add_console_options(CLI::App& command, ConsoleOptions& console, ViewChoice& view);

/// Plays the run, writes its results and prints their summary.
void play_and_write(SlamRun& run, const ConsoleOptions& console);

/// The same on a live sensor, whose first frame it waits for.
/// @param sink  receives every result; may be empty
/// @returns false if the source ended before its first frame
/// @throws Interrupted before the first frame
bool run_live(const RunOptions& options, const ConsoleOptions& console,
              std::unique_ptr<LiveSource> source, SlamRun::ResultSink sink = {});

}  // namespace mms
