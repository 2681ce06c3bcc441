#include "mms/training/run/schedule.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

constexpr ScheduleConfig kSchedule = {
    .images = 1000, .batch = 1, .learning_rate = 0.5, .warm_up = 100};

TEST(Schedule, RoundsStepsUp) {
  EXPECT_EQ(total_steps({.images = 17, .batch = 8}), 3);
  EXPECT_EQ(total_steps({.images = 16, .batch = 8}), 2);
}

TEST(Schedule, WarmsUpAndDropsTwice) {
  EXPECT_NEAR(learning_rate_at(kSchedule, 0), 0.005, 1e-12);
  EXPECT_NEAR(learning_rate_at(kSchedule, 50), 0.5 * 0.505, 1e-12);
  EXPECT_NEAR(learning_rate_at(kSchedule, 100), 0.5, 1e-12);
  EXPECT_NEAR(learning_rate_at(kSchedule, 749), 0.5, 1e-12);
  EXPECT_NEAR(learning_rate_at(kSchedule, 750), 0.05, 1e-12);
  EXPECT_NEAR(learning_rate_at(kSchedule, 920), 0.005, 1e-12);
}

TEST(Schedule, ShortTrainingHasShortWarmUp) {
  const ScheduleConfig schedule = {.images = 320, .batch = 8, .learning_rate = 0.5, .warm_up = 500};
  EXPECT_NEAR(learning_rate_at(schedule, 5), 0.5 * 0.505, 1e-12);
  EXPECT_NEAR(learning_rate_at(schedule, 10), 0.5, 1e-12);
  EXPECT_NEAR(learning_rate_at({.images = 1, .learning_rate = 0.5}, 0), 0.5, 1e-12);
}

TEST(Schedule, AverageDiscountsFirstSteps) {
  EXPECT_NEAR(ema_decay_at(kSchedule, 0), 0.1, 1e-12);
  EXPECT_NEAR(ema_decay_at(kSchedule, 1'000'000), kSchedule.ema, 1e-12);
}

}  // namespace
}  // namespace mms
