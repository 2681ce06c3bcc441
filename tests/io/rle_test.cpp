#include "mms/io/image/rle.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;

/// 4 x 3 with the L: (1, 0), (1, 1), (1, 2), (2, 2).
Image<std::uint8_t> l_shape() {
  Image<std::uint8_t> mask(4, 3);
  for (const auto& [x, y] : {std::pair(1, 0), {1, 1}, {1, 2}, {2, 2}}) mask(x, y) = 7;
  return mask;
}

/// A pattern with runs of every length, the first pixel on or off.
Image<std::uint8_t> pattern(int width, int height, unsigned seed) {
  Image<std::uint8_t> mask(width, height);
  unsigned state = seed;
  for (std::uint8_t& pixel : mask.pixels()) {
    state = state * 1664525U + 1013904223U;
    pixel = (state >> 24) < 90 + seed % 100 ? 1 : 0;
  }
  return mask;
}

TEST(Rle, RunsFollowColumns) {
  const Rle rle = encode_rle(l_shape());
  EXPECT_EQ(rle.counts, (std::vector<std::uint32_t>{3, 3, 2, 1, 3}));
  EXPECT_EQ(rle.width, 4);
  EXPECT_EQ(rle.height, 3);
  EXPECT_EQ(rle_area(rle), 4U);
  EXPECT_EQ(rle_box(rle), (std::array{1.0, 0.0, 2.0, 3.0}));
}

TEST(Rle, BeginsWithBackgroundRun) {
  EXPECT_EQ(encode_rle(Image<std::uint8_t>(2, 2, 1)).counts, (std::vector<std::uint32_t>{0, 4}));
  EXPECT_EQ(encode_rle(Image<std::uint8_t>(2, 2)).counts, (std::vector<std::uint32_t>{4}));
  EXPECT_EQ(rle_box(encode_rle(Image<std::uint8_t>(2, 2))), (std::array{0.0, 0.0, 0.0, 0.0}));
}

TEST(Rle, EncodesSingleLabel) {
  Image<std::uint8_t> labels = l_shape();
  labels(3, 0) = 2;
  EXPECT_EQ(rle_area(encode_rle(labels, 7)), 4U);
  EXPECT_EQ(rle_area(encode_rle(labels, 2)), 1U);
  EXPECT_EQ(rle_area(encode_rle(labels)), 5U);
}

TEST(Rle, TextEqualsPycocotools) {
  // Derived from its rule: from the fourth on, numbers are differences to the second last.
  EXPECT_EQ(rle_to_string({4, 3, {3, 3, 2, 1, 3}}), "332N1");
  EXPECT_EQ(rle_to_string({100, 100, {10000}}), "`h9");
  EXPECT_EQ(rle_from_string("332N1", 4, 3).counts, (std::vector<std::uint32_t>{3, 3, 2, 1, 3}));
}

TEST(Rle, RoundTrips) {
  for (unsigned seed = 0; seed < 100; seed += 9) {
    const Image<std::uint8_t> mask = pattern(31 + static_cast<int>(seed), 47, seed);
    const Rle rle = encode_rle(mask);
    EXPECT_EQ(decode_rle(rle).pixels(), mask.pixels());
    EXPECT_EQ(rle_from_string(rle_to_string(rle), rle.width, rle.height), rle);
  }
  const Rle large{4000, 3000, {11'999'999, 1}};
  EXPECT_EQ(rle_from_string(rle_to_string(large), 4000, 3000), large);
}

TEST(Rle, ErrorsExplainProblem) {
  expect_in("its runs have 5 pixels, the image has 4 x 3", message_of<DataError>([] {
              decode_rle({4, 3, {2, 3}});
            }));
  expect_in("has the character 'z', allowed: '0' to 'o'",
            message_of<DataError>([] { rle_from_string("3z", 4, 3); }));
  expect_in("ends within a number", message_of<DataError>([] { rle_from_string("`", 4, 3); }));
  expect_in("more than 32 bits",
            message_of<DataError>([] { rle_from_string("ooooooooooooo0", 4, 3); }));
  expect_in("has a run of 13 pixels in an image of 4 x 3",
            message_of<DataError>([] { rle_from_string("=", 4, 3); }));
  expect_in("has a run of -1 pixels", message_of<DataError>([] { rle_from_string("O", 4, 3); }));
}

/// A crop with holes, at the image's corners and over whole columns.
TEST(Rle, CropEqualsWholeImage) {
  for (const auto& [x, y, width, height] : std::vector<std::array<int, 4>>{
           {0, 0, 7, 5}, {2, 1, 7, 5}, {3, 0, 4, 6}, {0, 1, 7, 1}, {6, 5, 1, 1}}) {
    Image<std::uint8_t> crop(width, height);
    for (std::size_t i = 0; i < crop.size(); ++i) crop[i] = (i * 7 + 3) % 5 < 3 ? 1 : 0;
    Image<std::uint8_t> whole(9, 6);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) whole(x + u, y + v) = crop(u, v);
    }
    EXPECT_EQ(encode_rle(crop, x, y, 9, 6), encode_rle(whole));
    const Image<std::uint8_t> full(width, height, 1);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) whole(x + u, y + v) = 1;
    }
    EXPECT_EQ(encode_rle(full, x, y, 9, 6), encode_rle(whole));
  }
  const Image<std::uint8_t> none(3, 2);
  EXPECT_EQ(encode_rle(none, 1, 1, 9, 6), encode_rle(Image<std::uint8_t>(9, 6)));
}

TEST(Rle, RejectsCropOutsideImage) {
  EXPECT_THROW(encode_rle(Image<std::uint8_t>(3, 2, 1), 7, 0, 9, 6), DataError);
  EXPECT_THROW(encode_rle(Image<std::uint8_t>(3, 2, 1), -1, 0, 9, 6), DataError);
}

}  // namespace
}  // namespace mms
