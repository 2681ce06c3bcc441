#include "mms/geometry/image_overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mms {
namespace {

/// Values that differ everywhere, seen by a camera at (x0, y0).
Image<float> view_at(int x0, int y0) {
  Image<float> image(16, 12);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      image(x, y) = static_cast<float>(std::sin(0.7 * (x + x0)) + std::cos(1.1 * (y + y0)));
    }
  }
  return image;
}

TEST(ImageOverlap, IsPerfectAtTheTrueShift) {
  const Image<float> a = view_at(0, 0);
  const Image<float> b = view_at(3, -2);
  const ImageOverlap at_shift = image_overlap(a, b, -3, 2);
  EXPECT_EQ(at_shift.count, 13.0 * 10.0);
  EXPECT_NEAR(at_shift.correlation(), 1.0, 1e-6);
  EXPECT_NEAR(at_shift.variance_a, at_shift.variance_b, 1e-6);
  EXPECT_LT(image_overlap(a, b, 0, 0).correlation(), 0.9);
  EXPECT_LT(image_overlap(a, b, 3, -2).correlation(), 0.9);
}

TEST(ImageOverlap, LeavesOutUnknownPixels) {
  Image<float> a = view_at(0, 0);
  a(5, 5) = std::numeric_limits<float>::quiet_NaN();
  const ImageOverlap overlap = image_overlap(a, view_at(0, 0), 0, 0);
  EXPECT_EQ(overlap.count, 16.0 * 12.0 - 1.0);
  EXPECT_NEAR(overlap.correlation(), 1.0, 1e-6);
}

TEST(ImageOverlap, HasNoCorrelationWithoutOverlapOrTexture) {
  EXPECT_EQ(image_overlap(view_at(0, 0), view_at(0, 0), 16, 0).count, 0.0);
  EXPECT_EQ(image_overlap(view_at(0, 0), view_at(0, 0), 16, 0).correlation(), 0.0);
  EXPECT_EQ(image_overlap(Image<float>(4, 4, 1.0F), view_at(0, 0), 0, 0).correlation(), 0.0);
}

}  // namespace
}  // namespace mms
