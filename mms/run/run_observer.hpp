#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mms/run/record/run_log.hpp"

namespace mms {

/// Observes a run: displays its progress and may end it early.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  /// @param heading  lines of `run_heading`
  /// @param frames   largest number of frames
  virtual void on_start(const std::vector<std::string>& heading, std::size_t frames) = 0;

  /// A frame was processed; it is the last of `log`. Called in the thread of the run.
  virtual void on_frame(const RunLog& log) = 0;

  /// May be called from another thread.
  virtual void on_warning(const std::string& message) = 0;

  /// All frames were processed.
  virtual void on_end() = 0;

  /// Whether the run should end after the frames already read. Called in the reading thread.
  virtual bool stop_requested() const = 0;
};

}  // namespace mms
