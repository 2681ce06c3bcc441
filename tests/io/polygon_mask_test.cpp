#include "mms/io/image/polygon_mask.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;

Rle mask_of(const std::vector<Polygon>& polygons) {
  return rasterise(polygons, 20, 10);
}

TEST(PolygonMask, RectangleCoversItsPixels) {
  const Rle rle = mask_of({{2, 3, 7, 3, 7, 8, 2, 8}});
  EXPECT_EQ(rle_area(rle), 25U);
  EXPECT_EQ(rle_box(rle), (std::array{2.0, 3.0, 5.0, 5.0}));
}

TEST(PolygonMask, IsIndependentOfDirection) {
  EXPECT_EQ(mask_of({{2, 3, 7, 3, 7, 8, 2, 8}}), mask_of({{2, 8, 7, 8, 7, 3, 2, 3}}));
}

TEST(PolygonMask, UnitesSeveralPolygons) {
  const Rle rle = mask_of({{0, 0, 4, 0, 4, 4, 0, 4}, {2, 2, 6, 2, 6, 6, 2, 6}});
  EXPECT_EQ(rle_area(rle), 28U);
}

TEST(PolygonMask, EqualsUnionWithOutsidePolygon) {
  const Polygon outside = {100, 100, 101, 100, 101, 101};
  unsigned state = 7;
  const auto number = [&] {
    state = state * 1664525U + 1013904223U;
    return static_cast<double>(state >> 20) / 4096.0 * 30.0 - 5.0;
  };
  for (int corners = 3; corners < 40; ++corners) {
    Polygon polygon;
    for (int i = 0; i < 2 * corners; ++i) polygon.push_back(number());
    const Rle one = mask_of({polygon});
    check_rle(one);
    EXPECT_EQ(decode_rle(one).pixels(), decode_rle(mask_of({polygon, outside})).pixels());
  }
}

TEST(PolygonMask, ClipsToImage) {
  EXPECT_EQ(rle_area(mask_of({{-5, -5, 30, -5, 30, 30, -5, 30}})), 200U);
  EXPECT_EQ(rle_area(mask_of({{30, 30, 40, 30, 40, 40}})), 0U);
}

TEST(PolygonMask, TriangleHasHalfTheArea) {
  const auto area = static_cast<double>(rle_area(rasterise({{{0, 0, 100, 0, 0, 100}}}, 100, 100)));
  EXPECT_NEAR(area, 5000.0, 100.0);
}

TEST(PolygonMask, ErrorsExplainProblem) {
  expect_in("polygon: has 4 numbers (expected x and y of at least three corners",
            message_of<DataError>([] {
              mask_of({{0, 0, 1, 1}});
            }));
  message_of<DataError>([] { mask_of({{0, 0, 1, 1, 2, 2, 3}}); });
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  expect_in("allowed: finite", message_of<DataError>([] { mask_of({{0, 0, 1, 1, 2, kNan}}); }));
}

}  // namespace
}  // namespace mms
