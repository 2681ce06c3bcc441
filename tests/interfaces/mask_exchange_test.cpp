#include "interfaces/ros1/src/mask_exchange.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

namespace mms {
namespace {

using namespace std::chrono_literals;

constexpr auto kLong = 20s;  // longer than any test

Segmentation masks_of(int width) {
  return {width, 1, {}};
}

TEST(MaskExchange, ReturnsMasksOfTheirFrame) {
  MaskExchange exchange(kLong, kLong);
  for (const int t : {1, 2, 3}) exchange.sent(Timestamp(t));
  for (const int t : {1, 2, 3}) exchange.received(Timestamp(t), masks_of(t));
  for (const int t : {1, 2, 3}) EXPECT_EQ(exchange.wait_for(Timestamp(t))->width, t);
  EXPECT_EQ(exchange.counts().used, 3U);
  EXPECT_EQ(exchange.counts().missing, 0U);
}

TEST(MaskExchange, WaitsForMasksOfFrame) {
  MaskExchange exchange(kLong, kLong);
  exchange.sent(Timestamp(1));
  std::thread link([&] {
    std::this_thread::sleep_for(20ms);
    exchange.received(Timestamp(1), masks_of(7));
  });
  EXPECT_EQ(exchange.wait_for(Timestamp(1))->width, 7);
  EXPECT_GT(exchange.counts().delay_ms, 10.0);
  link.join();
}

TEST(MaskExchange, WaitsOfSuccessiveFramesOverlap) {
  constexpr int kFrames = 20;
  MaskExchange exchange(100ms, kLong);
  const auto start = MaskExchange::Clock::now();
  for (int t = 1; t <= kFrames; ++t) exchange.sent(Timestamp(t));
  for (int t = 1; t <= kFrames; ++t) EXPECT_FALSE(exchange.wait_for(Timestamp(t)));
  EXPECT_GE(MaskExchange::Clock::now() - start, 100ms);
  EXPECT_LT(MaskExchange::Clock::now() - start, kFrames * 50ms);
  EXPECT_EQ(exchange.counts().missing, 20U);
}

TEST(MaskExchange, MasksOfLaterFrameEndWait) {
  MaskExchange exchange(kLong, kLong);
  exchange.sent(Timestamp(1));
  exchange.sent(Timestamp(2));
  exchange.received(Timestamp(2), masks_of(2));
  EXPECT_FALSE(exchange.wait_for(Timestamp(1)));
  EXPECT_EQ(exchange.wait_for(Timestamp(2))->width, 2);
}

TEST(MaskExchange, CountsLateMasks) {
  MaskExchange exchange(1ms, kLong);
  exchange.sent(Timestamp(1));
  EXPECT_FALSE(exchange.wait_for(Timestamp(1)));
  exchange.received(Timestamp(1), masks_of(1));
  EXPECT_EQ(exchange.counts().late, 1U);
  exchange.received(Timestamp(9), masks_of(1));  // was never sent
  EXPECT_EQ(exchange.counts().late, 1U);
}

TEST(MaskExchange, DoesNotWaitWhileLinkIsLost) {
  MaskExchange exchange(kLong, 10ms);
  exchange.sent(Timestamp(1));
  std::this_thread::sleep_for(20ms);
  EXPECT_TRUE(exchange.counts().link_lost);
  EXPECT_FALSE(exchange.wait_for(Timestamp(1)));
  exchange.sent(Timestamp(2));
  exchange.received(Timestamp(2), masks_of(2));
  EXPECT_FALSE(exchange.counts().link_lost);
  EXPECT_EQ(exchange.wait_for(Timestamp(2))->width, 2);
}

TEST(MaskExchange, SlowLinkGetsFewerImages) {
  MaskExchange slow(0ms, kLong);  // all masks are too late
  MaskExchange fast(kLong, kLong);
  int t = 0;
  for (int i = 0; i < 10; ++i) {
    ++t;
    slow.sent(Timestamp(t));
    std::this_thread::sleep_for(1ms);
    slow.received(Timestamp(t), masks_of(1));
    fast.sent(Timestamp(t));
    fast.received(Timestamp(t), masks_of(1));
  }
  EXPECT_LT(slow.counts().window, 5.0);
  EXPECT_GT(fast.counts().window, 16.5);
  int in_flight = 0;
  for (; fast.may_send(); ++in_flight) fast.sent(Timestamp(++t));
  EXPECT_EQ(in_flight, static_cast<int>(std::ceil(fast.counts().window)));
}

TEST(MaskExchange, LinkRecoversWithOneAnswer) {
  constexpr auto kWait = 3s;
  MaskExchange exchange(kWait, kLong);
  int t = 0;
  while (exchange.may_send()) exchange.sent(Timestamp(++t));
  const int window = t;
  const auto loss = MaskExchange::Clock::now();
  while (!exchange.may_send()) std::this_thread::sleep_for(1ms);
  const auto pause = MaskExchange::Clock::now() - loss;
  EXPECT_GT(pause, kWait / 4);
  EXPECT_LT(pause, 2 * kWait);
  exchange.sent(Timestamp(++t));
  EXPECT_FALSE(exchange.may_send());  // one at a time
  exchange.received(Timestamp(t), masks_of(1));
  int free_slots = 0;
  for (; exchange.may_send(); ++free_slots) exchange.sent(Timestamp(++t));
  EXPECT_GE(free_slots, window);
}

TEST(MaskExchange, ClosingEndsWait) {
  MaskExchange exchange(kLong, kLong);
  exchange.sent(Timestamp(1));
  std::thread other([&] { exchange.close(); });
  EXPECT_FALSE(exchange.wait_for(Timestamp(1)));
  other.join();
}

TEST(MaskExchange, ForgetsMasksOfEarlierClock) {
  MaskExchange exchange(kLong, kLong);
  exchange.sent(Timestamp(100));
  exchange.received(Timestamp(100), masks_of(1));  // never taken
  exchange.forget();
  exchange.sent(Timestamp(1));
  std::thread link([&] {
    std::this_thread::sleep_for(20ms);
    exchange.received(Timestamp(1), masks_of(7));
  });
  EXPECT_FALSE(exchange.wait_for(Timestamp(100), 0));  // a frame of the clock before
  const auto masks = exchange.wait_for(Timestamp(1), exchange.clock());
  link.join();
  ASSERT_TRUE(masks);
  EXPECT_EQ(masks->width, 7);
}

}  // namespace
}  // namespace mms
