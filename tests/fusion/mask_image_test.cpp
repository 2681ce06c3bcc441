#include "mms/fusion/clouds/mask_image.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"

namespace mms {
namespace {

Instance square(int x, int y, int side, float score = 1.0F) {
  Instance instance;
  instance.x = x;
  instance.y = y;
  instance.score = score;
  instance.mask = Image<std::uint8_t>(side, side, 1);
  return instance;
}

TEST(MaskImage, OverlapTakesHigherScore) {
  const Segmentation segmentation{64, 48, {square(0, 0, 20, 0.9F), square(10, 10, 20, 0.5F)}};
  const MaskImage mask = make_mask_image(segmentation, 64, 48, 1, 0.0);
  EXPECT_EQ(mask.raw(5, 5), 1);
  EXPECT_EQ(mask.raw(15, 15), 1);
  EXPECT_EQ(mask.raw(25, 25), 2);
  EXPECT_EQ(mask.raw(40, 40), 0);
}

TEST(MaskImage, BlockIsCoveredByAnyOfItsPixels) {
  const Segmentation segmentation{64, 48, {square(11, 11, 1)}};
  const MaskImage mask = make_mask_image(segmentation, 64, 48, 2, 0.0);
  ASSERT_EQ(mask.raw.width(), 32);
  EXPECT_EQ(mask.raw(5, 5), 1);
  EXPECT_EQ(mask.raw(6, 5), 0);
}

TEST(MaskImage, DilationScalesWithImageWidth) {
  const Segmentation segmentation{640, 480, {square(300, 200, 20)}};
  const MaskImage mask = make_mask_image(segmentation, 640, 480, 1, 0.005);
  EXPECT_NE(mask.dilated(297, 210), 0);
  EXPECT_EQ(mask.dilated(296, 210), 0);
  EXPECT_EQ(mask.raw(299, 210), 0);
}

TEST(MaskImage, ClipsInstancesToImage) {
  const Segmentation segmentation{64, 48, {square(-10, -10, 20), square(60, 40, 20)}};
  const MaskImage mask = make_mask_image(segmentation, 64, 48, 2, 0.01);
  EXPECT_EQ(mask.raw(4, 4), 1);
  EXPECT_EQ(mask.raw(31, 23), 2);
}

TEST(MaskImage, EmptyWithoutSegmentation) {
  const MaskImage mask = make_mask_image({}, 64, 48, 2, 0.01);
  EXPECT_EQ(mask.dilated.width(), 32);
  EXPECT_EQ(mask.dilated(0, 0), 0);
  EXPECT_THROW(make_mask_image({32, 24, {}}, 64, 48, 2, 0.01), DataError);
}

}  // namespace
}  // namespace mms
