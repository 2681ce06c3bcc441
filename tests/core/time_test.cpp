#include "mms/core/time.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace mms {
namespace {

std::int64_t parsed(std::string_view text) {
  const auto stamp = Timestamp::parse(text);
  EXPECT_TRUE(stamp.has_value()) << "'" << text << "'";
  return stamp ? stamp->nanoseconds() : -1;
}

TEST(Timestamp, ParsesDecimalSeconds) {
  EXPECT_EQ(parsed("0"), 0);
  EXPECT_EQ(parsed("0.0"), 0);
  EXPECT_EQ(parsed("7"), 7'000'000'000);
  EXPECT_EQ(parsed("1305031102.175304"), 1'305'031'102'175'304'000);
  EXPECT_EQ(parsed("1.000000001"), 1'000'000'001);
  EXPECT_EQ(parsed("0.1"), 100'000'000);
  EXPECT_EQ(parsed("0.09"), 90'000'000);
  EXPECT_EQ(parsed("0007.5"), 7'500'000'000);
}

TEST(Timestamp, KeepsNanosecondsBeyondDoublePrecision) {
  // The spacing of doubles near 1.3e9 is 238 ns.
  EXPECT_EQ(parsed("1305031102.175304001"), 1'305'031'102'175'304'001);
  EXPECT_EQ(parsed("1305031102.175304002"), 1'305'031'102'175'304'002);
  EXPECT_EQ(parsed("9000000000.999999999"), 9'000'000'000'999'999'999);
}

TEST(Timestamp, DigitsBeyondNanosecondsDoNotOverflow) {
  EXPECT_EQ(parsed("1.0000000019999999999999999999"), 1'000'000'001);
  EXPECT_EQ(parsed("1.00000000000000000000000000000000000001"), 1'000'000'000);
}

TEST(Timestamp, RejectsMalformedText) {
  for (const char* text :
       {"",    " ",  ".",  ".5",   "-1",   "-0.5", "-0",  "+1",  "1e9",  "1.5e3", "abc", "1.2.3",
        "1,5", " 1", "1 ", "1.5 ", "1. 5", "0x10", "nan", "inf", "1.-5", "1.+5",  "--1"}) {
    EXPECT_FALSE(Timestamp::parse(text).has_value()) << "'" << text << "'";
  }
}

TEST(Timestamp, RejectsOverflow) {
  for (const char* text : {"9223372037", "9223372036.854775808", "99999999999.0",
                           "9223372036854775807", "123456789012345678901234567890.0"}) {
    EXPECT_FALSE(Timestamp::parse(text).has_value()) << text;
  }
}

TEST(Timestamp, WritesNineDecimals) {
  EXPECT_EQ(Timestamp(0).to_string(), "0.000000000");
  EXPECT_EQ(Timestamp(1).to_string(), "0.000000001");
  EXPECT_EQ(Timestamp(1'305'031'102'175'304'000).to_string(), "1305031102.175304000");
  EXPECT_EQ(Timestamp(-1).to_string(), "-0.000000001");
  EXPECT_EQ(Timestamp(-1'500'000'000).to_string(), "-1.500000000");
  EXPECT_EQ(Timestamp(INT64_MAX).to_string(), "9223372036.854775807");
  EXPECT_EQ(Timestamp(INT64_MIN).to_string(), "-9223372036.854775808");
}

TEST(Timestamp, ParseInvertsToString) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> any(0, 9'000'000'000'000'000'000);
  for (int i = 0; i < 1000; ++i) {
    const Timestamp stamp(any(random));
    EXPECT_EQ(Timestamp::parse(stamp.to_string()), stamp);
  }
}

TEST(Timestamp, FromSecondsRoundsToNanoseconds) {
  EXPECT_EQ(Timestamp::from_seconds(0.1).nanoseconds(), 100'000'000);
  EXPECT_EQ(Timestamp::from_seconds(1.0 / 3.0).nanoseconds(), 333'333'333);
  EXPECT_EQ(Timestamp::from_seconds(2.0 / 3.0).nanoseconds(), 666'666'667);
  EXPECT_EQ(Timestamp::from_seconds(-2.0 / 3.0).nanoseconds(), -666'666'667);
}

TEST(Timestamp, ArithmeticIsExact) {
  const Timestamp early(1'305'031'102'175'304'001);
  const Timestamp late = early + Duration(33'000'000);
  EXPECT_EQ((late - early).count(), 33'000'000);
  EXPECT_EQ((early - late).count(), -33'000'000);
  EXPECT_LT(early, late);
  EXPECT_DOUBLE_EQ(to_seconds(late - early), 0.033);
}

}  // namespace
}  // namespace mms
