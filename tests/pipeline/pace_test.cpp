#include "mms/pipeline/pace.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace mms {
namespace {

using namespace std::chrono_literals;

Timestamp stamp_of(Duration since_start) {
  return Timestamp(1'700'000'000'000'000'000) + since_start;
}

TEST(Pace, FramesComeWithTheIntervalsOfTheirStamps) {
  Pace pace;
  const Pace::Clock::time_point start = Pace::Clock::now();
  EXPECT_EQ(pace.due_at(stamp_of(0s), start), start);
  EXPECT_EQ(pace.due_at(stamp_of(100ms), start + 30ms), start + 100ms);
  EXPECT_EQ(pace.due_at(stamp_of(200ms), start + 400ms), start + 200ms);  // read late
  EXPECT_EQ(pace.due_at(stamp_of(10s), start + 500ms), start + 10s);
}

/// As where a recorder was stopped for a while, or the first stamps are those of an unset clock.
TEST(Pace, ShortensLongPauses) {
  Pace pace;
  const Pace::Clock::time_point start = Pace::Clock::now();
  pace.due_at(stamp_of(0s), start);
  const Pace::Clock::time_point after = pace.due_at(stamp_of(9000h), start + 1s);
  EXPECT_EQ(after, start + 1s + Pace::kMaxPause);
  EXPECT_EQ(pace.due_at(stamp_of(9000h + 100ms), after), after + 100ms);
}

}  // namespace
}  // namespace mms
