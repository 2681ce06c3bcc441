#pragma once

#include <cstddef>
#include <string>

#include "mms/run/record/run_log.hpp"

namespace mms {

/// Watches a run from outside: shows its progress, and may end it early.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  /// @param frames  how many are to come at most
  virtual void on_start(std::size_t frames) = 0;

  /// A frame is done; it is the last of `log`. In the thread that runs.
  virtual void on_frame(const RunLog& log) = 0;

  /// May come from another thread.
  virtual void on_warning(const std::string& message) = 0;

  /// All frames are done.
  virtual void on_end() = 0;

  /// Whether the run is to end with the frames that are in it. Asked by the reading thread.
  virtual bool stop_requested() const = 0;
};

}  // namespace mms
