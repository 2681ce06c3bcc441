#include "mms/evaluation/scores/metric_value.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mms {
namespace {

TEST(MetricValue, FormatsGivenDecimals) {
  EXPECT_EQ(to_fixed(1.23456, 2), "1.23");
  EXPECT_EQ(to_fixed(12.0, 0), "12");
  EXPECT_EQ(to_fixed(std::nan(""), 3), "n/a");
  EXPECT_EQ(to_fixed(INFINITY, 3), "n/a");
}

TEST(MetricValue, JsonKeepsOrderPrecisionAndIntegers) {
  const std::vector<MetricValue> values = {
      {"z", "", 3.0, "", 0}, {"a", "", 0.1234567890123, "m", 2}, {"n", "", std::nan(""), "m", 2}};
  EXPECT_EQ(to_json(values), R"({"z":3,"a":0.1234567890123,"n":null})");
}

TEST(MetricValue, TableAlignsNamesNumbersAndUnits) {
  const std::vector<MetricValue> values = {{"a", "poses", 120.0, "", 0},
                                           {"b", "ATE rmse", 0.5, "m", 3},
                                           {"c", "RPE", std::nan(""), "m", 3}};
  EXPECT_EQ(to_table(values),
            "poses       120\n"
            "ATE rmse  0.500 m\n"
            "RPE         n/a\n");
}

}  // namespace
}  // namespace mms
