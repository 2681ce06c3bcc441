#include "mms/dataset/live/frame_queue.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

Frame frame_of(int index) {
  Frame frame;
  frame.index = index;
  return frame;
}

TEST(FrameQueue, DropsOldestFrame) {
  FrameQueue queue(2);
  for (const int i : {0, 1, 2}) queue.push(frame_of(i));
  EXPECT_EQ(queue.dropped(), 1U);
  EXPECT_EQ(queue.pop()->index, 1);
  EXPECT_EQ(queue.pop()->index, 2);
}

TEST(FrameQueue, InterruptEndsOnePop) {
  FrameQueue queue(2);
  queue.push(frame_of(0));
  queue.interrupt();
  EXPECT_FALSE(queue.pop());
  queue.push(frame_of(1));
  EXPECT_EQ(queue.pop()->index, 1);
  queue.close();
  EXPECT_FALSE(queue.pop());
  EXPECT_FALSE(queue.pop());
}

TEST(FrameQueue, EndGivesWhatWaits) {
  FrameQueue queue(2);
  EXPECT_FALSE(queue.arrival());
  const auto before = FrameQueue::Clock::now();
  queue.push(frame_of(0));
  queue.end();
  EXPECT_EQ(queue.pop()->index, 0);
  EXPECT_GE(*queue.arrival(), before);
  EXPECT_FALSE(queue.pop());
  EXPECT_FALSE(queue.pop());
}

}  // namespace
}  // namespace mms
