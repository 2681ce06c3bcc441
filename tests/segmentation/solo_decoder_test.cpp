#include "mms/segmentation/solo_decoder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mms {
namespace {

/// Hand-made maps of the head: nothing is found until a cell is given an object.
class HandMadeMaps {
 public:
  HandMadeMaps() {
    config_.head.kernel_channels = 4;
    const auto grids = config_.head.grids();
    for (std::size_t i = 0; i < grids.size(); ++i) {
      const auto cells = static_cast<std::size_t>(grids[i] * grids[i]);
      categories_[i].assign(2 * cells, -10.0F);
      kernels_[i].assign(4 * cells, 0.0F);
      maps_.categories[i] = categories_[i].data();
      maps_.kernels[i] = kernels_[i].data();
    }
    features_.assign(4 * kWidth * kHeight, 0.0F);
    maps_.mask_features = features_.data();
    maps_.mask_width = kWidth;
    maps_.mask_height = kHeight;
    prepared_ = {{}, 4 * kWidth, 4 * kHeight, 4 * kWidth, 4 * kHeight, 8 * kWidth, 8 * kHeight};
  }

  /// A feature channel that is `inside` in a box of the mask map and `outside` elsewhere.
  void paint(std::size_t channel, int left, int top, int right, int bottom, float inside,
             float outside = -8.0F) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool in = x >= left && x <= right && y >= top && y <= bottom;
        features_[channel * kWidth * kHeight + static_cast<std::size_t>(y * kWidth + x)] =
            in ? inside : outside;
      }
    }
  }

  /// Lets a cell see the object of a channel.
  void set_cell(std::size_t level, int row, int column, int category, float logit,
                std::size_t channel) {
    const int side = config_.head.grids()[level];
    const int cell = row * side + column;
    categories_[level][static_cast<std::size_t>(category * side * side + cell)] = logit;
    kernels_[level][channel * static_cast<std::size_t>(side * side) +
                    static_cast<std::size_t>(cell)] = 1.0F;
  }

  std::vector<Detection> decoded(const DecoderConfig& config = {}) const {
    return decode(maps_, config_, prepared_, config);
  }

  static constexpr int kWidth = 16;
  static constexpr int kHeight = 12;

 private:
  NetworkConfig config_;
  std::array<std::vector<float>, HeadConfig::kLevels> categories_;
  std::array<std::vector<float>, HeadConfig::kLevels> kernels_;
  std::vector<float> features_;
  HeadMaps maps_;
  PreparedImage prepared_;
};

float sigmoid(float x) {
  return 1.0F / (1.0F + std::exp(-x));
}

TEST(SoloDecoder, FindsNothingInEmptyMaps) {
  EXPECT_TRUE(HandMadeMaps().decoded().empty());
}

TEST(SoloDecoder, GivesAnObjectWithItsScoreClassAndPlace) {
  HandMadeMaps maps;
  maps.paint(1, 4, 3, 9, 8, 4.0F);
  maps.set_cell(1, 5, 5, 1, 2.0F, 1);
  const std::vector<Detection> found = maps.decoded();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].category, 1);
  EXPECT_NEAR(found[0].score, sigmoid(2.0F) * sigmoid(4.0F), 1e-5);  // class times maskness
  EXPECT_NEAR(found[0].x, 4 * 8, 3);  // the box's corner at eight picture pixels a mask pixel
  EXPECT_NEAR(found[0].y, 3 * 8, 3);
  EXPECT_NEAR(found[0].mask.width(), 6 * 8, 5);
  EXPECT_NEAR(found[0].mask.height(), 6 * 8, 5);
  EXPECT_EQ(found[0].mask(10, 10), 1);
}

TEST(SoloDecoder, CellsBesideAHigherOneAreSilent) {
  HandMadeMaps maps;
  maps.paint(0, 2, 2, 6, 6, 4.0F);
  maps.set_cell(1, 5, 5, 0, 2.0F, 0);
  maps.set_cell(1, 6, 6, 0, 1.0F, 0);  // up and left of it is a higher one
  EXPECT_EQ(maps.decoded().size(), 1U);
}

TEST(SoloDecoder, TheSameObjectFromTwoLevelsLosesItsSecondScore) {
  HandMadeMaps maps;
  maps.paint(0, 2, 2, 6, 6, 4.0F);
  maps.set_cell(1, 5, 5, 0, 2.0F, 0);
  maps.set_cell(2, 3, 3, 0, 1.5F, 0);
  const std::vector<Detection> found = maps.decoded();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[1].score, sigmoid(1.5F) * sigmoid(4.0F) * std::exp(-2.0F), 1e-4);
  EXPECT_EQ(maps.decoded({.score = 0.3}).size(), 1U);
}

TEST(SoloDecoder, TooSmallMasksAreDropped) {
  HandMadeMaps maps;
  maps.paint(0, 2, 2, 4, 3, 4.0F);  // 6 pixels, the first levels want more than 8
  maps.set_cell(0, 5, 5, 0, 2.0F, 0);
  EXPECT_TRUE(maps.decoded().empty());
}

TEST(SoloDecoder, KeepsAtMostSoManyInstances) {
  HandMadeMaps maps;
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
