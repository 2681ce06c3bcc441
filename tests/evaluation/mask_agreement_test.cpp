#include "mms/evaluation/segmentation/mask_agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mms {
namespace {

LabeledCloud cloud_of(const std::vector<PointLabel>& labels) {
  LabeledCloud cloud;
  cloud.width = static_cast<int>(labels.size());
  cloud.height = 1;
  cloud.labels = labels;
  return cloud;
}

TEST(MaskAgreement, CountsOnlyPointsWithDepth) {
  constexpr auto kStatic = PointLabel::kStatic;
  constexpr auto kDynamic = PointLabel::kDynamic;
  constexpr auto kInvalid = PointLabel::kInvalid;
  Image<std::uint8_t> mask(6, 1);
  mask[0] = mask[1] = mask[2] = 1;
  mask[3] = 255;
  MaskAgreement agreement;
  agreement.add(mask, cloud_of({kDynamic, kDynamic, kStatic, kInvalid, kDynamic, kStatic}));
  EXPECT_EQ(agreement.hits, 2);
  EXPECT_EQ(agreement.missed, 1);
  EXPECT_EQ(agreement.extra, 1);
  agreement.add(mask, cloud_of({kDynamic, kStatic, kStatic, kDynamic, kStatic, kStatic}));
  EXPECT_NEAR(agreement.recall(), 4.0 / 7.0, 1e-12);
  EXPECT_NEAR(agreement.precision(), 4.0 / 5.0, 1e-12);
}

TEST(MaskAgreement, PointCoversBlockOfPixels) {
  Image<std::uint8_t> mask(4, 2);
  mask(1, 1) = 1;
  MaskAgreement agreement;
  agreement.add(mask, cloud_of({PointLabel::kDynamic, PointLabel::kDynamic}));
  EXPECT_EQ(agreement.hits, 1);
  EXPECT_EQ(agreement.extra, 1);
}

TEST(MaskAgreement, IsNanWithoutMasks) {
  MaskAgreement agreement;
  agreement.add({}, cloud_of({PointLabel::kStatic}));
  EXPECT_TRUE(std::isnan(agreement.recall()));
  EXPECT_TRUE(std::isnan(agreement.precision()));
}

}  // namespace
}  // namespace mms
