#include "mms/core/bounded_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace mms {
namespace {

TEST(BoundedQueue, PopsItemsInOrder) {
  BoundedQueue<int> queue(3);
  for (const int i : {1, 2, 3}) EXPECT_TRUE(queue.push(i));
  for (const int i : {1, 2, 3}) EXPECT_EQ(queue.pop(), i);
}

TEST(BoundedQueue, HoldsAtMostItsCapacity) {
  BoundedQueue<int> queue(2);
  EXPECT_TRUE(queue.try_push(1));
  EXPECT_TRUE(queue.try_push(2));
  EXPECT_FALSE(queue.try_push(3));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_TRUE(queue.try_push(4));
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(), 4);
}

TEST(BoundedQueue, ClosedQueueOnlyPopsRemainingItems) {
  BoundedQueue<int> queue(4);
  queue.push(1);
  queue.push(2);
  EXPECT_FALSE(queue.is_closed());
  queue.close();
  EXPECT_TRUE(queue.is_closed());
  EXPECT_FALSE(queue.push(3));
  EXPECT_FALSE(queue.try_push(3));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(), std::nullopt);
  queue.close();
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, CloseWakesBlockedConsumers) {
  BoundedQueue<int> queue(1);
  std::vector<std::thread> waiting;
  std::atomic<int> woken = 0;
  for (int i = 0; i < 3; ++i) waiting.emplace_back([&] { woken += !queue.pop().has_value(); });
  queue.close();
  for (std::thread& thread : waiting) thread.join();
  EXPECT_EQ(woken, 3);
}

TEST(BoundedQueue, CloseWakesBlockedProducers) {
  BoundedQueue<int> queue(1);
  queue.push(0);
  std::vector<std::thread> waiting;
  std::atomic<int> rejected = 0;
  for (int i = 0; i < 3; ++i) waiting.emplace_back([&] { rejected += !queue.push(1); });
  queue.close();
  for (std::thread& thread : waiting) thread.join();
  EXPECT_EQ(rejected, 3);
  EXPECT_EQ(queue.pop(), 0);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, KeepsOrderBetweenThreads) {
  constexpr int kItems = 20000;
  BoundedQueue<std::unique_ptr<int>> queue(3);  // items that can only be moved
  std::thread producer([&] {
    for (int i = 0; i < kItems; ++i) queue.push(std::make_unique<int>(i));
    queue.close();
  });
  int expected = 0;
  while (const auto item = queue.pop()) {
    ASSERT_EQ(**item, expected);
    ++expected;
  }
  producer.join();
  EXPECT_EQ(expected, kItems);
}

}  // namespace
}  // namespace mms
