#include "mms/segmentation/solo/solo_decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mms {
namespace {

/// Synthetic maps of the head, without an object until a cell gets one.
class SyntheticMaps {
 public:
  explicit SyntheticMaps(bool window = false) {
    config_.head.kernel_channels = kChannels;
    config_.head.window = window;
    const auto grids = config_.head.grids();
    for (std::size_t i = 0; i < grids.size(); ++i) {
      const auto cells = static_cast<std::size_t>(grids[i] * grids[i]);
      for (std::size_t cell = 0; cell < cells; ++cell) {
        cells_[i].insert(cells_[i].end(), kCellPitch, 0.0F);
        std::fill_n(cells_[i].end() - 2, 2, -10.0F);
      }
      maps_.kernels[i] = {cells_[i].data(), kCellPitch};
      maps_.categories[i] = {cells_[i].data() + kCategories, kCellPitch};
    }
    features_.assign(kFeaturePitch * kWidth * kHeight, 0.0F);
    maps_.mask_features = {features_.data(), kFeaturePitch};
    maps_.mask_width = kWidth;
    maps_.mask_height = kHeight;
    prepared_ = {{}, 4 * kWidth, 4 * kHeight, 4 * kWidth, 4 * kHeight, 8 * kWidth, 8 * kHeight};
  }

  /// A feature channel that is `inside` in a box of the mask map and `outside` elsewhere.
  void paint(std::size_t channel, int left, int top, int right, int bottom, float inside,
             float outside = -8.0F) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool is_inside = x >= left && x <= right && y >= top && y <= bottom;
        features_[static_cast<std::size_t>((y * kWidth + x) * kFeaturePitch) + channel] =
            is_inside ? inside : outside;
      }
    }
  }

  /// Assigns the object of a channel to a cell.
  void set_cell(std::size_t level, int row, int column, int category, float logit,
                std::size_t channel) {
    const int side = config_.head.grids()[level];
    const int cell = (row * side + column) * kCellPitch;
    cells_[level][static_cast<std::size_t>(cell + kCategories + category)] = logit;
    cells_[level][static_cast<std::size_t>(cell) + channel] = 1.0F;
  }

  /// The window of a cell: a, b, c, d of `HeadConfig::kWindowTerms`.
  void set_window(std::size_t level, int row, int column, const std::array<float, 4>& terms) {
    const int cell = (row * config_.head.grids()[level] + column) * kCellPitch;
    std::copy(terms.begin(), terms.end(), cells_[level].begin() + cell + kChannels);
  }

  std::vector<Detection> decoded(const DecoderConfig& config = {}) const {
    return decode(maps_, config_, prepared_, config);
  }

  static constexpr int kWidth = 16;
  static constexpr int kHeight = 12;

 private:
  NetworkConfig config_;
  static constexpr int kChannels = 4;
  static constexpr int kCategories = kChannels + HeadConfig::kWindowTerms;
  static constexpr int kCellPitch = kCategories + 2;  // a kernel, a window, two categories
  static constexpr int kFeaturePitch = 5;             // one float more than channels

  std::array<std::vector<float>, HeadConfig::kLevels> cells_;
  std::vector<float> features_;
  HeadMaps maps_;
  PreparedImage prepared_;
};

float sigmoid(float x) {
  return 1.0F / (1.0F + std::exp(-x));
}

TEST(SoloDecoder, NoDetectionsInEmptyMaps) {
  EXPECT_TRUE(SyntheticMaps().decoded().empty());
}

TEST(SoloDecoder, DetectsObjectWithScoreClassAndPosition) {
  SyntheticMaps maps;
  maps.paint(1, 4, 3, 9, 8, 4.0F);
  maps.set_cell(1, 5, 5, 1, 2.0F, 1);
  const std::vector<Detection> found = maps.decoded();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].category, 1);
  EXPECT_NEAR(found[0].score, sigmoid(2.0F) * sigmoid(4.0F), 1e-5);  // class times maskness
  EXPECT_NEAR(found[0].x, 4 * 8, 3);  // the box's corner, at eight image pixels per mask pixel
  EXPECT_NEAR(found[0].y, 3 * 8, 3);
  EXPECT_NEAR(found[0].mask.width(), 6 * 8, 5);
  EXPECT_NEAR(found[0].mask.height(), 6 * 8, 5);
  EXPECT_EQ(found[0].mask(10, 10), 1);
}

TEST(SoloDecoder, SuppressesCellsBesideHigherOne) {
  SyntheticMaps maps;
  maps.paint(0, 2, 2, 6, 6, 4.0F);
  maps.set_cell(1, 5, 5, 0, 2.0F, 0);
  maps.set_cell(1, 6, 6, 0, 1.0F, 0);  // a higher one is up and left of it
  EXPECT_EQ(maps.decoded().size(), 1U);
}

TEST(SoloDecoder, MatrixNmsDecaysDuplicateOfOtherLevel) {
  SyntheticMaps maps;
  maps.paint(0, 2, 2, 6, 6, 4.0F);
  maps.set_cell(1, 5, 5, 0, 2.0F, 0);
  maps.set_cell(2, 3, 3, 0, 1.5F, 0);
  const std::vector<Detection> found = maps.decoded();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[1].score, sigmoid(1.5F) * sigmoid(4.0F) * std::exp(-2.0F), 1e-4);
  EXPECT_EQ(maps.decoded({.score = 0.3}).size(), 1U);
}

/// Twelve objects that overlap, of two classes and three levels.
SyntheticMaps crowded_maps() {
  SyntheticMaps maps;
  for (int i = 0; i < 4; ++i) {
    maps.paint(static_cast<std::size_t>(i), 2 * i, i, 2 * i + 6, i + 6,
               1.0F + static_cast<float>(i));
  }
  for (int i = 0; i < 12; ++i) {
    const float logit = 2.5F - 0.35F * static_cast<float>(i % 7) - 0.02F * static_cast<float>(i);
    maps.set_cell(static_cast<std::size_t>(i % 3), i, 0, i % 2, logit,
                  static_cast<std::size_t>(i % 4));
  }
  return maps;
}

TEST(SoloDecoder, ScoreThresholdDoesNotChangeRemaining) {
  const SyntheticMaps maps = crowded_maps();
  const std::vector<Detection> all = maps.decoded({.score = 0.0});
  ASSERT_GT(all.size(), 8U);
  for (const double score : {0.05, 0.3, 0.5, 0.7}) {
    const std::vector<Detection> found = maps.decoded({.score = score});
    std::size_t expected = 0;
    while (expected < all.size() && all[expected].score >= static_cast<float>(score)) ++expected;
    ASSERT_EQ(found.size(), expected) << score;
    for (std::size_t i = 0; i < expected; ++i) {
      EXPECT_EQ(found[i].score, all[i].score);
      EXPECT_EQ(found[i].category, all[i].category);
      EXPECT_EQ(found[i].mask.pixels(), all[i].mask.pixels());
    }
  }
}

TEST(SoloDecoder, DropsTooSmallMasks) {
  SyntheticMaps maps;
  maps.paint(0, 2, 2, 4, 3, 4.0F);  // 6 pixels; the first levels need more than 8
  maps.set_cell(0, 5, 5, 0, 2.0F, 0);
  EXPECT_TRUE(maps.decoded().empty());
}

/// Two cells with one kernel that finds the whole map: each window keeps what is near its cell.
TEST(SoloDecoder, WindowsSeparateObjectsOfOneFeature) {
  SyntheticMaps maps(true);
  maps.paint(0, 0, 0, 15, 11, 4.0F);
  const float decay = std::log(std::expm1(0.2F));  // its softplus is 0.2
  for (const int column : {5, 16}) {
    maps.set_cell(1, 10, column, 0, 2.0F, 0);
    maps.set_window(1, 10, column, {decay, decay, 0.0F, 0.0F});
  }
  const std::vector<Detection> found = maps.decoded();
  ASSERT_EQ(found.size(), 2U);
  const int first = found[0].x < found[1].x ? 0 : 1;
  const double cell = 128.0 / 22.0;  // its width [px of the image], grid of 22 cells
  for (const int i : {0, 1}) {
    const Detection& object = found[static_cast<std::size_t>(i == 0 ? first : 1 - first)];
    const double center = object.x + 0.5 * object.mask.width();
    EXPECT_NEAR(center, ((i == 0 ? 5 : 16) + 0.5) * cell, 4.0);
    EXPECT_NEAR(object.mask.width(), 2 * std::sqrt(4.0 / 0.2) * cell, 8.0);  // 4 - 0.2 x^2 is 0
  }
}

TEST(SoloDecoder, LinearTermsMoveTheWindow) {
  SyntheticMaps maps(true);
  maps.paint(0, 0, 0, 15, 11, 0.0F);
  const float decay = std::log(std::expm1(1.0F));
  maps.set_cell(1, 10, 10, 0, 2.0F, 0);
  maps.set_window(1, 10, 10, {decay, decay, 4.0F, 4.0F});  // 8 - (x - 2)^2 - (y - 2)^2
  const std::vector<Detection> found = maps.decoded();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].x + 0.5 * found[0].mask.width(), 12.5 * 128 / 22, 4.0);
  EXPECT_NEAR(found[0].y + 0.5 * found[0].mask.height(), 12.5 * 96 / 22, 4.0);
  EXPECT_NEAR(found[0].mask.width(), 2 * std::sqrt(8.0) * 128 / 22, 8.0);
}

TEST(SoloDecoder, LimitsNumberOfInstances) {
  SyntheticMaps maps;
  maps.paint(0, 0, 0, 4, 4, 4.0F);
  maps.paint(1, 8, 6, 12, 10, 4.0F);
  maps.set_cell(1, 2, 2, 0, 1.0F, 0);
  maps.set_cell(1, 12, 12, 0, 3.0F, 1);
  const std::vector<Detection> found = maps.decoded({.instances = 1});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(found[0].x, 40);  // the better one
}

}  // namespace
}  // namespace mms
