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

/// A hundred frames of large images would fill the memory of a small computer.
TEST(FrameQueue, DropsOldestFrameBeyondItsSize) {
  const auto large = [](int index) {
    Frame frame = frame_of(index);
    frame.color = Image<Rgb>(100, 100);    // 30 kB
    frame.depth = Image<float>(100, 100);  // 40 kB
    return frame;
  };
  FrameQueue queue(100, 150'000);
  for (const int i : {0, 1, 2}) queue.push(large(i));
  EXPECT_EQ(queue.dropped(), 1U);
  EXPECT_EQ(queue.pop()->index, 1);
  queue.push(large(3));
  EXPECT_EQ(queue.dropped(), 1U);
  queue.interrupt();
  EXPECT_FALSE(queue.pop());
  for (const int i : {4, 5}) queue.push(large(i));
  EXPECT_EQ(queue.dropped(), 1U);
  FrameQueue small(100, 1000);
  small.push(large(0));
  EXPECT_EQ(small.dropped(), 0U);  // one may always wait
  EXPECT_EQ(small.pop()->index, 0);
}

TEST(FrameQueue, DroppedFramesHandOnMotionAndPlace) {
  const auto place = [](double x) {
    return Transform<Global, Sensor>(Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)));
  };
  FrameQueue queue(2);
  for (const int i : {0, 1, 2, 3, 4}) {
    Frame frame = frame_of(i);
    frame.motion.imu = {{Timestamp(2 * i)}, {Timestamp(2 * i + 1)}};
    frame.motion.wheels = {{Timestamp(i), {}}};
    if (i == 1) frame.expected_place = place(1.0);
    if (i == 4) frame.expected_place = place(4.0);
    queue.push(std::move(frame));
  }
  EXPECT_EQ(queue.dropped(), 3U);
  const auto next = queue.pop();
  ASSERT_EQ(next->index, 3);
  ASSERT_EQ(next->motion.imu.size(), 8U);
  ASSERT_EQ(next->motion.wheels.size(), 4U);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(next->motion.imu[static_cast<std::size_t>(i)].stamp, Timestamp(i));
  }
  EXPECT_EQ(next->motion.wheels.front().stamp, Timestamp(0));
  EXPECT_EQ(next->motion.wheels.back().stamp, Timestamp(3));
  ASSERT_TRUE(next->expected_place);
  EXPECT_EQ(next->expected_place->translation().x(), 1.0);
  const auto last = queue.pop();
  EXPECT_EQ(last->motion.imu.size(), 2U);
  EXPECT_EQ(last->expected_place->translation().x(), 4.0);
}

TEST(FrameQueue, SamplesOfDroppedFramesDoNotFillTheMemory) {
  FrameQueue queue(1);
  for (int second = 0; second < 200; ++second) {
    Frame frame = frame_of(second);
    ImuSample& sample = frame.motion.imu.emplace_back();
    sample.stamp = Timestamp::from_seconds(second);
    queue.push(std::move(frame));
  }
  const std::optional<Frame> last = queue.pop();
  EXPECT_LE(last->motion.imu.size(), 62U);
  EXPECT_GE(last->motion.imu.size(), 60U);
  EXPECT_EQ(last->motion.imu.back().stamp, Timestamp::from_seconds(199.0));
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

TEST(FrameQueue, DropsNothingAfterItsEnd) {
  FrameQueue queue(1);
  queue.push(frame_of(0));
  queue.close();
  for (const int i : {1, 2, 3}) queue.push(frame_of(i));
  EXPECT_EQ(queue.dropped(), 0U);
}

}  // namespace
}  // namespace mms
