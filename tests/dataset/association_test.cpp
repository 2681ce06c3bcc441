#include "mms/dataset/source/frame_association.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace mms {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::vector<Timestamp> milliseconds(std::initializer_list<std::int64_t> values) {
  std::vector<Timestamp> stamps;
  for (const std::int64_t value : values) stamps.emplace_back(value * 1'000'000);
  return stamps;
}

Pairs associate_20ms(const std::vector<Timestamp>& a, const std::vector<Timestamp>& b) {
  return associate(a, b, std::chrono::milliseconds(20));
}

TEST(Association, MatchesNearest) {
  EXPECT_EQ(associate_20ms(milliseconds({0, 100, 200}), milliseconds({95, 5, 110})),
            (Pairs{{0, 1}, {1, 0}}));
}

TEST(Association, LimitIsInclusive) {
  EXPECT_EQ(associate_20ms(milliseconds({0, 100}), milliseconds({20, 121})), (Pairs{{0, 0}}));
}

TEST(Association, UsesStampsOnceNearestPairsFirst) {
  // 10 is nearer to 12 than 0; 0 has no match.
  EXPECT_EQ(associate_20ms(milliseconds({0, 10}), milliseconds({12})), (Pairs{{1, 0}}));
  // 15 matches 14, so 0 matches the more distant -10.
  EXPECT_EQ(associate_20ms(milliseconds({0, 15}), milliseconds({14, -10})),
            (Pairs{{0, 1}, {1, 0}}));
}

TEST(Association, EqualDifferencesMatchEarlierStamp) {
  EXPECT_EQ(associate_20ms(milliseconds({10, 0}), milliseconds({5})), (Pairs{{1, 0}}));
}

TEST(Association, EmptyListsGiveNoPairs) {
  EXPECT_TRUE(associate_20ms({}, milliseconds({1})).empty());
  EXPECT_TRUE(associate_20ms(milliseconds({1}), {}).empty());
}

TEST(Association, EqualStampsArePairsInTheirOrder) {
  EXPECT_EQ(associate_20ms(milliseconds({5, 5, 90}), milliseconds({5, 5, 91})),
            (Pairs{{0, 0}, {1, 1}, {2, 2}}));
}

}  // namespace
}  // namespace mms
