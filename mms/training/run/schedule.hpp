#pragma once

#include "mms/training/data/training_config.hpp"

namespace mms {

/// Number of steps for all images.
int total_steps(const ScheduleConfig& schedule);

/// Learning rate of a step, from 0: linear warm-up, then a tenth after each drop.
double learning_rate_at(const ScheduleConfig& schedule, int step);

/// Decay of the average in a step: smaller in the first steps, so that initial weights have no
/// influence.
double ema_decay_at(const ScheduleConfig& schedule, int step);

}  // namespace mms
