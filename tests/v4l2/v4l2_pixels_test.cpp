#include <gtest/gtest.h>

#include <vector>

#include "mms/dataset/camera/v4l2_pixels.hpp"

namespace mms {
namespace {

TEST(V4l2Pixels, YuyvHasColorsOfBt601) {
  // Black and white, pure red twice, and pure blue twice, with two bytes after each row.
  const std::vector<std::uint8_t> bytes = {16,  128, 235, 128, 0,   0,  81,  90, 81,
                                           240, 0,   0,   41,  240, 41, 110, 0,  0};
  const Image<Rgb> color = color_from_yuyv(bytes, {2, 3, 6});
  const auto expect_near = [](const Rgb& a, int r, int g, int b) {
    EXPECT_NEAR(a.r, r, 1);
    EXPECT_NEAR(a.g, g, 1);
    EXPECT_NEAR(a.b, b, 1);
  };
  expect_near(color(0, 0), 0, 0, 0);
  expect_near(color(1, 0), 255, 255, 255);
  expect_near(color(0, 1), 255, 0, 0);
  expect_near(color(1, 1), 255, 0, 0);
  expect_near(color(0, 2), 0, 0, 255);
  expect_near(color(1, 2), 0, 0, 255);
}

TEST(V4l2Pixels, Z16IsLittleEndianAndZeroIsNoReturn) {
  const std::vector<std::uint8_t> bytes = {0, 0, 0x10, 0x27, 0xFF, 0xFF, 1, 0};
  const Image<float> depth = depth_from_z16(bytes, {2, 2, 4}, 1000.0);
  EXPECT_EQ(depth(0, 0), 0.0F);
  EXPECT_EQ(depth(1, 0), 10.0F);
  EXPECT_EQ(depth(0, 1), 65.535F);
  EXPECT_EQ(depth(1, 1), 0.001F);
}

TEST(V4l2Pixels, ImagesThatAreCutOffAreRecognized) {
  const std::vector<std::uint8_t> bytes(3 * 64 + 8);
  EXPECT_TRUE(holds_image(bytes, {4, 4, 64}));  // the last row without its end
  EXPECT_FALSE(holds_image(std::span(bytes).first(3 * 64 + 7), {4, 4, 64}));
  EXPECT_FALSE(holds_image(bytes, {4, 4, 7}));
  EXPECT_FALSE(holds_image(bytes, {0, 4, 64}));
  EXPECT_FALSE(holds_image(bytes, {4, -1, 64}));
}

}  // namespace
}  // namespace mms
