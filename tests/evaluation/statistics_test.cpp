#include "mms/evaluation/scores/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace mms {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Statistics, PercentileIsNearestRank) {
  const std::vector<double> values = {50, 15, 40, 20, 35};
  EXPECT_EQ(percentile(values, 0), 15);
  EXPECT_EQ(percentile(values, 5), 15);
  EXPECT_EQ(percentile(values, 30), 20);
  EXPECT_EQ(percentile(values, 40), 20);
  EXPECT_EQ(percentile(values, 50), 35);
  EXPECT_EQ(percentile(values, 100), 50);
}

TEST(Statistics, PercentilesOfHundredValues) {
  std::vector<double> values(100);
  std::iota(values.begin(), values.end(), 1.0);
  for (int percent = 1; percent <= 100; ++percent) EXPECT_EQ(percentile(values, percent), percent);
}

TEST(Statistics, MedianAveragesTwoCentralValues) {
  EXPECT_EQ(median(std::vector<double>{4, 1, 3, 2}), 2.5);
  EXPECT_EQ(median(std::vector<double>{9, 1, 3}), 3);
}

TEST(Statistics, IgnoresNan) {
  const std::vector<double> values = {kNaN, 3, kNaN, 4};
  EXPECT_EQ(mean(values), 3.5);
  EXPECT_EQ(maximum(values), 4);
  EXPECT_EQ(root_mean_square(values), std::sqrt(12.5));
}

TEST(Statistics, EmptyInputGivesNan) {
  for (const std::vector<double>& none : {std::vector<double>{}, std::vector<double>{kNaN}}) {
    EXPECT_TRUE(std::isnan(percentile(none, 50)));
    EXPECT_TRUE(std::isnan(median(none)));
    EXPECT_TRUE(std::isnan(mean(none)));
    EXPECT_TRUE(std::isnan(root_mean_square(none)));
    EXPECT_TRUE(std::isnan(maximum(none)));
  }
}

}  // namespace
}  // namespace mms
