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

TEST(Association, TakesTheNearest) {
  EXPECT_EQ(associate_20ms(milliseconds({0, 100, 200}), milliseconds({95, 5, 110})),
            (Pairs{{0, 1}, {1, 0}}));
}

TEST(Association, TheLimitIsInclusive) {
  EXPECT_EQ(associate_20ms(milliseconds({0, 100}), milliseconds({20, 121})), (Pairs{{0, 0}}));
}

TEST(Association, EachStampIsUsedOnceNearestPairsFirst) {
  // 10 is nearer to 12 than 0 is; 0 is left with nothing.
  EXPECT_EQ(associate_20ms(milliseconds({0, 10}), milliseconds({12})), (Pairs{{1, 0}}));
  // 15 goes to 14, so that 0 takes the farther -10.
  EXPECT_EQ(associate_20ms(milliseconds({0, 15}), milliseconds({14, -10})),
            (Pairs{{0, 1}, {1, 0}}));
}

TEST(Association, EqualDifferencesGoToTheEarlierStamp) {
  EXPECT_EQ(associate_20ms(milliseconds({10, 0}), milliseconds({5})), (Pairs{{1, 0}}));
}

TEST(Association, NothingMatchesNothing) {
  EXPECT_TRUE(associate_20ms({}, milliseconds({1})).empty());
  EXPECT_TRUE(associate_20ms(milliseconds({1}), {}).empty());
}

}  // namespace
}  // namespace mms
