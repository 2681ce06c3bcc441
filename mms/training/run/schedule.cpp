#include "mms/training/run/schedule.hpp"

#include <algorithm>

namespace mms {

int total_steps(const ScheduleConfig& schedule) {
  return (schedule.images + schedule.batch - 1) / schedule.batch;
}

double learning_rate_at(const ScheduleConfig& schedule, int step) {
  constexpr double kFirst = 0.01;  // of the largest rate
  constexpr double kDrop = 0.1;
  constexpr int kWarmUpPart = 4;  // the warm-up is at most 1 / kWarmUpPart of all steps
  double rate = schedule.learning_rate;
  const int warm_up = std::min(schedule.warm_up, total_steps(schedule) / kWarmUpPart);
  if (step < warm_up) {
    return rate * (kFirst + (1.0 - kFirst) * step / warm_up);
  }
  const double done = static_cast<double>(step) / total_steps(schedule);
  if (done >= schedule.first_drop) rate *= kDrop;
  if (done >= schedule.second_drop) rate *= kDrop;
  return rate;
}

double ema_decay_at(const ScheduleConfig& schedule, int step) {
  return std::min(schedule.ema, (1.0 + step) / (10.0 + step));
}

}  // namespace mms
