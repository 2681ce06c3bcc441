#pragma once

#include <optional>

#include "apps/mms/console/rate_progress.hpp"
#include "mms/training/run/training_run.hpp"

namespace mms {

/// Shows a training on stderr: a progress line, and the APs of validations.
class TrainingProgress {
 public:
  void show(const TrainingEvent& event);
  void finish();

 private:
  RateProgress loading_{"image read,"};
  std::optional<RateProgress> training_;
};

}  // namespace mms
