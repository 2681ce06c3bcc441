#include "mms/io/text/numbers.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mms/io/text/stamp_reader.hpp"

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

std::vector<std::int64_t> numbers_from(std::int64_t first, std::int64_t step) {
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < 5; ++i) numbers.push_back(first + step * i);
  return numbers;
}

TEST(StampReader, KnowsNanosecondsSinceTheStartOfASensor) {
  const auto are = [](std::int64_t first, std::int64_t step) {
    return are_nanoseconds_since_start(numbers_from(first, step), kLongestImageStep);
  };
  EXPECT_TRUE(are(5'000'000'000'000, 33'333'333)) << "not milliseconds since 1970";
  EXPECT_TRUE(are(5'000'000'000'000'000, 33'333'333)) << "not microseconds since 1970";
  EXPECT_TRUE(are(50'000'000'000, 33'333'333)) << "no other unit";
  EXPECT_TRUE(are(2'000'000'000, 33'333'333)) << "not seconds";
  EXPECT_FALSE(are(1'400'000'000'000, 33)) << "milliseconds";
  EXPECT_FALSE(are(1'400'000'000'000, 5'000)) << "milliseconds";
  EXPECT_FALSE(are(1'400'000'000'000'000, 33'333)) << "microseconds";
  EXPECT_FALSE(are(1'400'000'000'000'000, 2'000'000)) << "microseconds";
  EXPECT_FALSE(are(1'400'000'000'000'000'000, 33'333'333)) << "nanoseconds since 1970";
  EXPECT_FALSE(are(1'400'000'000, 1)) << "seconds";
  EXPECT_FALSE(are(0, 1)) << "a count";
  EXPECT_FALSE(are_nanoseconds_since_start({5'000'000'000'000, 5'000'033'333'333}, 10.0));
}

}  // namespace
}  // namespace mms
