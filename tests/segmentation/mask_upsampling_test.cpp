#include "mms/segmentation/solo/mask_upsampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mms {
namespace {

struct Case {
  int mask_width, mask_height;
  PreparedImage prepared;
};

/// An image whose scaled part fills a mask except its lowest rows.
Case case_of(int image_width, int image_height) {
  Case c{20, 16, {}};
  c.prepared.image_width = image_width;
  c.prepared.image_height = image_height;
  c.prepared.valid_width = 4 * c.mask_width;
  c.prepared.valid_height = 4 * c.mask_height - 7;
  return c;
}

/// The probability at an image pixel by definition.
double expected_probability(const Case& c, const std::vector<float>& soft, int x, int y) {
  const auto position = [](int pixel, int image, int valid, int mask) {
    const double at = (pixel + 0.5) * valid / image / 4.0 - 0.5;
    return std::clamp(at, 0.0, mask - 1.0);
  };
  const double u = position(x, c.prepared.image_width, c.prepared.valid_width, c.mask_width);
  const double v = position(y, c.prepared.image_height, c.prepared.valid_height, c.mask_height);
  const auto at = [&](int row, int column) {
    return soft[static_cast<std::size_t>(std::min(row, c.mask_height - 1) * c.mask_width +
                                         std::min(column, c.mask_width - 1))];
  };
  const int i = static_cast<int>(u);
  const int j = static_cast<int>(v);
  const double low = at(j, i) + (u - i) * (at(j, i + 1) - at(j, i));
  const double high = at(j + 1, i) + (u - i) * (at(j + 1, i + 1) - at(j + 1, i));
  return low + (v - j) * (high - low);
}

/// Checks an upsampled mask pixel by pixel.
void expect_pixels(const Case& c, const std::vector<float>& soft, const Detection& found) {
  for (int y = 0; y < c.prepared.image_height; ++y) {
    for (int x = 0; x < c.prepared.image_width; ++x) {
      const double probability = expected_probability(c, soft, x, y);
      if (std::abs(probability - 0.5) < 1e-5) continue;  // rounding decides
      const int u = x - found.x;
      const int v = y - found.y;
      const bool inside = found.mask.contains(u, v) && found.mask(u, v) != 0;
      EXPECT_EQ(inside, probability > 0.5) << x << ' ' << y;
    }
  }
}

/// Expects set pixels in the first and last row and column.
void expect_cropped(const Image<std::uint8_t>& mask) {
  if (mask.empty()) return;
  int left = 0, right = 0, top = 0, bottom = 0;
  for (int y = 0; y < mask.height(); ++y) left += mask(0, y), right += mask(mask.width() - 1, y);
  for (int x = 0; x < mask.width(); ++x) top += mask(x, 0), bottom += mask(x, mask.height() - 1);
  for (const int count : {left, right, top, bottom}) EXPECT_GT(count, 0);
}

TEST(UpsampledMask, EqualsDefinitionPixelByPixel) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> column(0, 19);
  std::uniform_int_distribution<int> row(0, 15);
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  for (const auto& [width, height] : {std::pair(160, 114), {77, 53}, {20, 15}, {9, 7}}) {
    for (int round = 0; round < 10; ++round) {
      const Case c = case_of(width, height);
      std::vector<float> soft(20 * 16, 0.1F);
      const int left = column(random), top = row(random);
      for (int y = top; y < std::min(16, top + 7); ++y) {
        for (int x = left; x < std::min(20, left + 9); ++x) {
          soft[static_cast<std::size_t>(y * 20 + x)] = uniform(random);
        }
      }
      const Detection found = upsampled_mask(soft, c.mask_width, c.prepared);
      expect_pixels(c, soft, found);
      expect_cropped(found.mask);
    }
  }
}

TEST(UpsampledMask, IsEmptyWithoutPixels) {
  const Case c = case_of(160, 114);
  EXPECT_TRUE(upsampled_mask(std::vector<float>(20 * 16, 0.4F), 20, c.prepared).mask.empty());
}

TEST(UpsampledMask, FullMaskCoversImage) {
  const Case c = case_of(160, 114);
  const Detection all = upsampled_mask(std::vector<float>(20 * 16, 0.9F), 20, c.prepared);
  EXPECT_EQ(all.x, 0);
  EXPECT_EQ(all.y, 0);
  EXPECT_EQ(all.mask.width(), 160);
  EXPECT_EQ(all.mask.height(), 114);
}

}  // namespace
}  // namespace mms
