#include "mms/io/text/numbers.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace mms {
namespace {

TEST(Numbers, ParsesOnlyWholeText) {
  EXPECT_EQ(parse_double("1.5"), 1.5);
  EXPECT_EQ(parse_double("+1.5e3"), 1500.0);
  EXPECT_FALSE(parse_double(""));
  EXPECT_FALSE(parse_double("1.5x"));
  EXPECT_FALSE(parse_double("+-1"));
  EXPECT_FALSE(parse_double("1e999"));
  EXPECT_EQ(parse_integer("-7"), -7);
  EXPECT_FALSE(parse_integer("7.0"));
  EXPECT_FALSE(parse_integer("99999999999999999999"));
}

TEST(Numbers, FormatIsShortAndExact) {
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(3.0), "3");
  EXPECT_EQ(format_number(100000.0), "100000");
  EXPECT_EQ(format_number(0.0001234567890123456), "0.0001234567890123456");
  for (const double value : {1.0 / 3.0, 1e-300, -2.5e17, std::numeric_limits<double>::max()}) {
    EXPECT_EQ(parse_double(format_number(value)), value);
  }
}

TEST(Numbers, ParsesDecimalStampsExactly) {
  EXPECT_EQ(parse_stamp("1305031102.175304123")->nanoseconds(), 1305031102175304123);
  EXPECT_EQ(parse_stamp("1.5e+01")->nanoseconds(), 15'000'000'000);
  EXPECT_EQ(parse_stamp("-2.5")->nanoseconds(), -2'500'000'000);
  EXPECT_FALSE(parse_stamp("nan"));
  EXPECT_FALSE(parse_stamp("123456789012"));
  EXPECT_FALSE(parse_stamp("1e300"));
}

TEST(Numbers, ParsesStampsInOtherUnits) {
  EXPECT_EQ(parse_stamp("1403636579763555584")->nanoseconds(), 1403636579763555584);
  EXPECT_EQ(parse_stamp("1403636579763555")->nanoseconds(), 1403636579763555000);
  EXPECT_EQ(parse_stamp("1403636579763")->nanoseconds(), 1403636579763000000);
  EXPECT_EQ(parse_stamp("1403636579763.5")->nanoseconds(), 1403636579763000000);
  EXPECT_EQ(parse_stamp("-3")->nanoseconds(), -3'000'000'000);
}

}  // namespace
}  // namespace mms
