#include "mms/segmentation/solo/prepared_image.hpp"

#include <gtest/gtest.h>

#include "mms/segmentation/solo/resize.hpp"

namespace mms {
namespace {

TEST(Resize, KeepsConstantImage) {
  const Image<Rgb> flat(37, 23, Rgb{10, 130, 250});
  for (const auto& [w, h] : {std::pair(20, 11), {80, 60}, {37, 23}, {1, 1}}) {
    const Image<Rgb> resized = resize(flat, w, h);
    ASSERT_EQ(resized.width(), w);
    ASSERT_EQ(resized.height(), h);
    for (const Rgb& pixel : resized.pixels()) EXPECT_EQ(pixel, (Rgb{10, 130, 250}));
  }
}

/// A ramp stays a ramp: pixel areas are aligned, so value(x) = 2 (x + 0.5) - 0.5 at half the size.
TEST(Resize, KeepsRampInPlace) {
  Image<Rgb> ramp(100, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 100; ++x) ramp(x, y).r = static_cast<std::uint8_t>(2 * x);
  }
  const Image<Rgb> half = resize(ramp, 50, 2);
  for (int x = 2; x < 48; ++x) EXPECT_NEAR(half(x, 0).r, 2 * (2 * (x + 0.5) - 0.5), 1.0);
  const Image<Rgb> twice = resize(ramp, 200, 8);
  for (int x = 2; x < 198; ++x) EXPECT_NEAR(twice(x, 3).r, 2 * ((x + 0.5) / 2 - 0.5), 1.0);
}

TEST(Resize, AveragesAllPixelsWhenShrinking) {
  Image<Rgb> stripes(64, 1);
  for (int x = 0; x < 64; x += 2) stripes(x, 0) = {200, 200, 200};
  const Image<Rgb> small = resize(stripes, 8, 1);
  for (const Rgb& pixel : small.pixels()) EXPECT_NEAR(pixel.g, 100, 4);
}

TEST(Resize, PartEqualsThatOfTheWhole) {
  Image<Rgb> image(31, 17);
  for (std::size_t i = 0; i < image.size(); ++i) {
    image.pixels()[i] = {static_cast<std::uint8_t>(i * 37), static_cast<std::uint8_t>(i * 101),
                         static_cast<std::uint8_t>(i * 7)};
  }
  for (const auto& [w, h] : {std::pair(62, 40), {31, 17}, {13, 9}}) {
    const Image<Rgb> whole = resize(image, w, h);
    for (const Window window : {Window{0, 0, w, h}, {3, 2, 5, 4}, {w - 4, h - 3, 4, 3}}) {
      const Image<Rgb> part = resize_part(image, w, h, window);
      for (int y = 0; y < window.height; ++y) {
        for (int x = 0; x < window.width; ++x) {
          ASSERT_EQ(part(x, y), whole(window.x + x, window.y + y)) << w << ": " << x << ' ' << y;
        }
      }
    }
  }
}

TEST(PreparedImage, FitsCameraImageToNetworkSize) {
  const PreparedImage prepared = prepare_image(Image<Rgb>(640, 480), NetworkConfig());
  EXPECT_EQ(prepared.valid_width, 320);
  EXPECT_EQ(prepared.valid_height, 240);
  EXPECT_EQ(prepared.width, 320);
  EXPECT_EQ(prepared.height, 256);
  EXPECT_EQ(prepared.planes.size(), 3U * 320 * 256);
}

TEST(PreparedImage, NormalizesAndPadsWithZero) {
  const PreparedImage prepared =
      prepare_image(Image<Rgb>(640, 480, {255, 0, 128}), NetworkConfig());
  EXPECT_NEAR(prepared.planes[0], (255 - 123.675) / 58.395, 1e-4);
  EXPECT_NEAR(prepared.planes[320 * 256], (0 - 116.28) / 57.12, 1e-4);
  EXPECT_NEAR(prepared.planes[2 * 320 * 256], (128 - 103.53) / 57.375, 1e-4);
  EXPECT_EQ(prepared.planes[320 * 240], 0.0F);  // the first row of padding
}

TEST(PreparedImage, KeepsPortraitOrientation) {
  const PreparedImage prepared = prepare_image(Image<Rgb>(480, 640), NetworkConfig());
  EXPECT_EQ(prepared.width, 256);
  EXPECT_EQ(prepared.height, 320);
}

TEST(PreparedImage, PadsPanoramasToMinimumHeight) {
  const PreparedImage prepared = prepare_image(Image<Rgb>(2000, 100), NetworkConfig());
  EXPECT_EQ(prepared.valid_width, 320);
  EXPECT_EQ(prepared.valid_height, 16);
  EXPECT_EQ(prepared.height, 96);
}

}  // namespace
}  // namespace mms
