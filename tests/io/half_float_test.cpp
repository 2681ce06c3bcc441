#include "mms/io/weights/half_float.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace mms {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(HalfFloat, EveryFiniteHalfRoundTrips) {
  int finite = 0;
  for (std::uint32_t i = 0; i <= 0xFFFF; ++i) {
    const auto bits = static_cast<std::uint16_t>(i);
    const float value = float_from_half(bits);
    if (!std::isfinite(value)) {
      EXPECT_EQ(half_from_float(value), std::nullopt);
      continue;
    }
    ASSERT_EQ(half_from_float(value), bits) << value;
    ++finite;
  }
  EXPECT_EQ(finite, 63488);  // 2 signs, 31 exponents, 1024 fractions
}

TEST(HalfFloat, ConvertsKnownValues) {
  EXPECT_EQ(float_from_half(0x3C00), 1.0F);
  EXPECT_EQ(float_from_half(0xC000), -2.0F);
  EXPECT_EQ(float_from_half(0x3555), 0.333251953125F);
  EXPECT_EQ(float_from_half(0x7BFF), 65504.0F);
  EXPECT_EQ(float_from_half(0x0400), 0x1p-14F);
  EXPECT_EQ(float_from_half(0x03FF), 1023 * 0x1p-24F);
  EXPECT_EQ(float_from_half(0x0001), 0x1p-24F);
  EXPECT_TRUE(std::signbit(float_from_half(0x8000)));
  EXPECT_EQ(float_from_half(0xFC00), -kInfinity);
  EXPECT_TRUE(std::isnan(float_from_half(0x7E01)));
}

TEST(HalfFloat, RoundsToNearestAndTiesToEven) {
  EXPECT_EQ(half_from_float(1.0F + 0x1p-11F), 0x3C00);             // tie: down to even
  EXPECT_EQ(half_from_float(1.0F + 3 * 0x1p-11F), 0x3C02);         // tie: up to even
  EXPECT_EQ(half_from_float(1.0F + 0x1p-11F + 0x1p-23F), 0x3C01);  // just above
  EXPECT_EQ(half_from_float(-1.0F - 3 * 0x1p-11F), 0xBC02);        // the sign changes nothing
  EXPECT_EQ(half_from_float(2.0F - 0x1p-12F), 0x4000);             // carries into the exponent
  EXPECT_EQ(half_from_float(0x1p-14F - 0x1p-26F), 0x0400);         // becomes normal
}

TEST(HalfFloat, RoundsSubnormals) {
  EXPECT_EQ(half_from_float(0x1p-25F), 0x0000);         // tie: to zero, which is even
  EXPECT_EQ(half_from_float(-0x1p-25F), 0x8000);        // the sign stays
  EXPECT_EQ(half_from_float(0x1.000002p-25F), 0x0001);  // just above
  EXPECT_EQ(half_from_float(3 * 0x1p-25F), 0x0002);     // tie: up to even
  EXPECT_EQ(half_from_float(5 * 0x1p-25F), 0x0002);     // tie: down to even
  EXPECT_EQ(half_from_float(1e-40F), 0x0000);           // a float's own subnormal
}

TEST(HalfFloat, ReturnsNothingForTooLargeValues) {
  EXPECT_EQ(half_from_float(65504.0F), 0x7BFF);
  EXPECT_EQ(half_from_float(std::nextafter(65520.0F, 0.0F)), 0x7BFF);
  EXPECT_EQ(half_from_float(65520.0F), std::nullopt);
  EXPECT_EQ(half_from_float(-1e30F), std::nullopt);
  EXPECT_EQ(half_from_float(kInfinity), std::nullopt);
  EXPECT_EQ(half_from_float(std::numeric_limits<float>::quiet_NaN()), std::nullopt);
}

TEST(HalfFloat, BfloatIsUpperHalfOfFloat) {
  EXPECT_EQ(float_from_bfloat(0x3F80), 1.0F);
  EXPECT_EQ(float_from_bfloat(0xC049), -3.140625F);
  EXPECT_EQ(float_from_bfloat(0x0001), std::bit_cast<float>(0x00010000U));
}

}  // namespace
}  // namespace mms
