#include "mms/server/viewer/playhead.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace mms {
namespace {

using Clock = Playhead::Clock;
using namespace std::chrono_literals;

/// 0.0 s, 0.1 s, ... 1.9 s.
std::vector<Timestamp> stamps() {
  std::vector<Timestamp> all;
  for (int i = 0; i < 20; ++i) all.emplace_back(i * 100'000'000LL);
  return all;
}

const Clock::time_point kStart{};

std::size_t frame_at(Playhead& head, Clock::duration time) {
  head.advance(stamps(), kStart + time);
  return head.frame();
}

TEST(Playhead, PlaysAtPaceOfStamps) {
  Playhead head;
  EXPECT_EQ(frame_at(head, 0ms), 0U);
  EXPECT_EQ(frame_at(head, 99ms), 0U);
  EXPECT_EQ(frame_at(head, 101ms), 1U);
  EXPECT_EQ(frame_at(head, 1550ms), 15U);
  EXPECT_TRUE(head.playing());
  EXPECT_EQ(frame_at(head, 1min), 19U);
  EXPECT_TRUE(head.ended());
  EXPECT_FALSE(head.playing());
}

TEST(Playhead, RestartsAfterEnd) {
  Playhead head;
  frame_at(head, 0ms);
  frame_at(head, 1min);
  head.play(kStart + 2min);
  EXPECT_FALSE(head.ended());
  EXPECT_EQ(frame_at(head, 2min + 250ms), 2U);
}

TEST(Playhead, ResumesAtPausedFrame) {
  Playhead head;
  frame_at(head, 0ms);
  EXPECT_EQ(frame_at(head, 350ms), 3U);
  head.pause();
  EXPECT_EQ(frame_at(head, 10s), 3U);
  head.play(kStart + 10s);
  EXPECT_EQ(frame_at(head, 10s + 150ms), 4U);
}

TEST(Playhead, ChangesSpeedWithoutJump) {
  Playhead head;
  frame_at(head, 0ms);
  frame_at(head, 400ms);
  head.set_speed(2.0, kStart + 400ms);
  EXPECT_EQ(frame_at(head, 400ms), 4U);
  EXPECT_EQ(frame_at(head, 900ms), 14U);
}

TEST(Playhead, SeeksWithinRun) {
  Playhead head;
  frame_at(head, 0ms);
  head.seek(10);
  EXPECT_EQ(frame_at(head, 500ms), 10U);
  EXPECT_EQ(frame_at(head, 750ms), 12U);
  head.seek(1'000'000);
  EXPECT_EQ(frame_at(head, 800ms), 19U);
}

TEST(Playhead, StepsSingleFramesAndPauses) {
  Playhead head;
  frame_at(head, 0ms);
  head.step(1);
  EXPECT_FALSE(head.playing());
  EXPECT_EQ(frame_at(head, 10s), 1U);
  head.step(-5);
  EXPECT_EQ(frame_at(head, 10s), 0U);
  head.step(-2147483647 - 1);
  EXPECT_EQ(frame_at(head, 10s), 0U);
}

TEST(Playhead, FollowsNewestOfLiveRun) {
  Playhead head;
  head.follow(0);
  EXPECT_EQ(head.frame(), 0U);
  head.follow(12);
  EXPECT_EQ(head.frame(), 11U);
  EXPECT_TRUE(head.follows());
  head.seek(3);
  head.follow(20);
  EXPECT_EQ(head.frame(), 3U);
  EXPECT_FALSE(head.playing());
  head.play(kStart);
  head.follow(20);
  EXPECT_EQ(head.frame(), 19U);
}

TEST(Playhead, StaysAtEndOfLiveRunAndRestarts) {
  Playhead head;
  head.follow(20);
  EXPECT_EQ(frame_at(head, 1h), 19U);
  EXPECT_TRUE(head.ended());
  head.play(kStart + 1h);
  EXPECT_EQ(frame_at(head, 1h + 310ms), 3U);
}

TEST(Playhead, AcceptsRunWithoutFrames) {
  Playhead head;
  head.seek(7);
  head.advance({}, kStart);
  EXPECT_EQ(head.frame(), 0U);
  head.seek(7);
  head.follow(0);
  EXPECT_EQ(head.frame(), 0U);
}

}  // namespace
}  // namespace mms
