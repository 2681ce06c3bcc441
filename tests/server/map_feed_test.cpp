#include "mms/server/viewer/map_feed.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

using Clock = MapFeed::Clock;
using namespace std::chrono_literals;

constexpr std::size_t kLarge = 200'000;  ///< points of a chunk that make a map large

ChunkState chunk(int x, std::size_t points = kLarge, std::uint64_t version = 1) {
  return {{x, 0, 0}, version, points, Eigen::Vector3f(static_cast<float>(x), 0.0F, 0.0F)};
}

/// "x/level" of all tasks.
std::vector<std::string> drain(MapFeed& feed, Clock::time_point now) {
  std::vector<std::string> tasks;
  while (const auto task = feed.next(now)) {
    tasks.push_back(std::to_string(task->key.x) +
                    (task->version == 0 ? "/gone" : "/" + std::to_string(task->level)));
  }
  return tasks;
}

using Tasks = std::vector<std::string>;
const Eigen::Vector3f kOrigin = Eigen::Vector3f::Zero();
const Clock::time_point kStart{};

TEST(MapFeed, SendsLargeMapCoarseThenNearestFirst) {
  MapFeed feed(10 * kLarge);
  feed.plan({chunk(5), chunk(1), chunk(-3)}, kOrigin, kStart);
  EXPECT_EQ(drain(feed, kStart), (Tasks{"1/3", "-3/3", "5/3", "1/0", "-3/0", "5/0"}));
}

TEST(MapFeed, SendsSmallMapInFullResolution) {
  MapFeed feed(10 * kLarge);
  feed.plan({chunk(5, 100), chunk(1, 100)}, kOrigin, kStart);
  EXPECT_EQ(drain(feed, kStart), (Tasks{"1/0", "5/0"}));
}

TEST(MapFeed, SendsNothingTwice) {
  MapFeed feed(10 * kLarge);
  feed.plan({chunk(1, 100)}, kOrigin, kStart);
  drain(feed, kStart);
  feed.plan({chunk(1, 100)}, kOrigin, kStart + 1h);
  EXPECT_EQ(drain(feed, kStart + 1h), Tasks{});
}

TEST(MapFeed, LimitsRateOfChangedChunks) {
  MapFeed feed(10 * kLarge);
  feed.plan({chunk(1, 100), chunk(2, 100)}, kOrigin, kStart);
  drain(feed, kStart);
  feed.plan({chunk(1, 100, 2), chunk(2, 100)}, kOrigin, kStart + 10ms);
  EXPECT_EQ(drain(feed, kStart + 10ms), Tasks{});
  EXPECT_TRUE(feed.deferred());
  feed.plan({chunk(1, 100, 2), chunk(2, 100)}, kOrigin, kStart + 2s);
  EXPECT_EQ(drain(feed, kStart + 2s), Tasks{"1/0"});
  EXPECT_FALSE(feed.deferred());
}

TEST(MapFeed, ReportsRemovedChunks) {
  MapFeed feed(10 * kLarge);
  feed.plan({chunk(1, 100), chunk(2, 100)}, kOrigin, kStart);
  drain(feed, kStart);
  feed.plan({chunk(2, 100)}, kOrigin, kStart);
  EXPECT_EQ(drain(feed, kStart), Tasks{"1/gone"});
  feed.plan({chunk(2, 100)}, kOrigin, kStart);
  EXPECT_EQ(drain(feed, kStart), Tasks{});
}

TEST(MapFeed, KeepsDistantChunksCoarseWithinBudget) {
  MapFeed feed(kLarge + kLarge / 4 + kLarge / 16);
  const std::vector<ChunkState> map = {chunk(1), chunk(2), chunk(3)};
  feed.plan(map, kOrigin, kStart);
  EXPECT_EQ(drain(feed, kStart), (Tasks{"1/3", "2/3", "3/3", "1/0", "2/1", "3/2"}));
  feed.plan(map, Eigen::Vector3f(3.0F, 0.0F, 0.0F), kStart);
  EXPECT_EQ(drain(feed, kStart), (Tasks{"3/0", "1/2"})) << "the viewer's focus moved";
  feed.set_budget(10 * kLarge);
  feed.plan(map, kOrigin, kStart);
  EXPECT_EQ(drain(feed, kStart), (Tasks{"1/0", "2/0"}));
}

TEST(MapFeed, NewPlanReplacesUnsentTasks) {
  MapFeed feed(10 * kLarge);
  feed.plan({chunk(1, 100), chunk(2, 100)}, kOrigin, kStart);
  ASSERT_TRUE(feed.next(kStart));
  feed.plan({chunk(1, 100), chunk(2, 100), chunk(3, 100)}, kOrigin, kStart);
  EXPECT_EQ(drain(feed, kStart), (Tasks{"2/0", "3/0"}));
}

}  // namespace
}  // namespace mms
