#pragma once

#include "mms/training/data/training_config.hpp"

namespace mms {

/// Number of steps until all images were seen.
int total_steps(const ScheduleConfig& schedule);

/// Learning rate of a step, from 0: a linear warm-up, then a tenth after each drop.
double learning_rate_at(const ScheduleConfig& schedule, int step);

/// How much of the average is kept in a step: less in the first steps, so that it forgets the
/// initial weights.
double ema_decay_at(const ScheduleConfig& schedule, int step);

}  // namespace mms
