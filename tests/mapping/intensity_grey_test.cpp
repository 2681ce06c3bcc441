#include "mms/mapping/static_map/intensity_grey.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

TEST(IntensityGrey, IsInverted) {
  std::vector<Rgb> greys;
  for (int i = 0; i <= 255; ++i) greys.push_back(grey_of(static_cast<std::uint8_t>(i)));
  const std::vector<float> intensities = intensities_of(greys);
  ASSERT_EQ(intensities.size(), greys.size());
  // Half a grey of 200 moves the root by 1/400.
  for (int i = 0; i <= 255; ++i) {
    const float intensity = static_cast<float>(i) / 255.0F;
    EXPECT_NEAR(intensities[static_cast<std::size_t>(i)], intensity, 0.006F) << i;
  }
}

TEST(IntensityGrey, KnowsColorsOfCamerasAndMapsWithoutIntensity) {
  EXPECT_TRUE(intensities_of({grey_of(7), {200, 100, 100}}).empty());
  EXPECT_TRUE(intensities_of({grey_of(7), {20, 20, 20}}).empty());
  EXPECT_TRUE(intensities_of({kNoColor, kNoColor}).empty());
  EXPECT_TRUE(intensities_of({}).empty());
}

}  // namespace
}  // namespace mms
