#pragma once

#include <optional>

#include "mms/training/training_run.hpp"
#include "rate_progress.hpp"

namespace mms {

/// Shows a training on stderr: a progress line, and the APs as they are measured.
class TrainingProgress {
 public:
  void show(const TrainingEvent& event);
  void finish();

 private:
  RateProgress loading_{"image read,"};
  std::optional<RateProgress> training_;
};

}  // namespace mms
