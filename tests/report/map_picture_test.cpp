#include "mms/report/map_picture.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr Rgb kRed{255, 0, 0};
constexpr Rgb kGreen{0, 255, 0};
constexpr Rgb kBlue{0, 0, 255};

using Points = std::vector<Eigen::Vector3f>;
using Colors = std::vector<Rgb>;

/// Mean pixel of a color.
Eigen::Vector2d pixel_of(const Image<Rgb>& picture, const Rgb& color) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (picture(x, y) == color) {
        sum += Eigen::Vector2d(x, y);
        ++count;
      }
    }
  }
  return sum / count;
}

constexpr MapPictureOptions kSmall = {.width = 120, .height = 90};

TEST(ViewAxes, AreRightHandedAndUnit) {
  for (const UpAxis up : {UpAxis::kNegativeY, UpAxis::kPositiveZ}) {
    for (const Viewpoint viewpoint : {Viewpoint::kTop, Viewpoint::kFront}) {
      const ViewAxes axes = view_axes(viewpoint, up);
      EXPECT_TRUE(axes.right.cross(axes.up).isApprox(axes.to_viewer));
      EXPECT_EQ(axes.right.norm(), 1.0);
      const double viewer_height = height(axes.to_viewer, up);
      EXPECT_EQ(viewer_height, viewpoint == Viewpoint::kTop ? 1.0 : 0.0);
    }
  }
}

TEST(MapPicture, TopViewHasXRightAndZUp) {
  const Points points = {{0, 0, 0}, {2, 0, 0}, {0, 0, 1}};
  const auto picture = draw_map(points, Colors{kRed, kGreen, kBlue}, kSmall);
  const auto origin = pixel_of(picture, kRed);
  const auto right = pixel_of(picture, kGreen);
  const auto forward = pixel_of(picture, kBlue);
  EXPECT_GT(right.x(), origin.x() + 50);
  EXPECT_NEAR(right.y(), origin.y(), 1.0);
  EXPECT_NEAR(forward.x(), origin.x(), 1.0);
  EXPECT_LT(forward.y(), origin.y());
  // Equal aspect: two metres are twice as long as one.
  EXPECT_NEAR(right.x() - origin.x(), 2.0 * (origin.y() - forward.y()), 3.0);
}

TEST(MapPicture, TopViewShowsHigherPoint) {
  const Points camera_world = {{0, 1, 0}, {0, -1, 0}};
  const auto picture = draw_map(camera_world, Colors{kRed, kGreen}, kSmall);
  EXPECT_TRUE(std::isnan(pixel_of(picture, kRed).x()));
  EXPECT_FALSE(std::isnan(pixel_of(picture, kGreen).x()));
}

TEST(MapPicture, ExcludesCeiling) {
  MapPictureOptions options = kSmall;
  options.max_height = 0.5;
  const auto picture = draw_map(Points{{0, 1, 0}, {0, -1, 0}}, Colors{kRed, kGreen}, options);
  EXPECT_TRUE(std::isnan(pixel_of(picture, kGreen).x()));
}

TEST(MapPicture, FrontViewShowsNearestPointInFront) {
  MapPictureOptions options = kSmall;
  options.viewpoint = Viewpoint::kFront;
  options.up = UpAxis::kPositiveZ;
  const Points points = {{5, 0, 0}, {2, 0, 0}, {-2, 0, 0}};
  const auto picture = draw_map(points, Colors{kRed, kGreen, kBlue}, options);
  EXPECT_TRUE(std::isnan(pixel_of(picture, kRed).x()));
  EXPECT_FALSE(std::isnan(pixel_of(picture, kGreen).x()));
  EXPECT_TRUE(std::isnan(pixel_of(picture, kBlue).x()));
}

TEST(MapPicture, OutliersDoNotChangeScale) {
  Points points = {{1000, 0, 1000}};
  for (int i = 0; i < 400; ++i) points.emplace_back(0.01F * static_cast<float>(i), 0, 0);
  Colors colors(points.size(), kGreen);
  const auto picture = draw_map(points, colors, kSmall);
  EXPECT_FALSE(picture(10, 45) == picture(0, 0));
}

TEST(MapPicture, ColorsByHeightWithoutColors) {
  const auto picture = draw_map(Points{{0, 1, 0}, {1, -1, 0}}, {}, kSmall);
  Colors colors;
  for (const Rgb& pixel : picture.pixels()) {
    if (std::find(colors.begin(), colors.end(), pixel) == colors.end()) colors.push_back(pixel);
  }
  EXPECT_EQ(colors.size(), 3U);
}

TEST(MapPicture, IsBackgroundWithoutPoints) {
  const Points invalid = {{std::nanf(""), 0, 0}};
  for (const Points& points : {Points{}, invalid}) {
    const auto picture = draw_map(points, {}, kSmall);
    EXPECT_EQ(picture.width(), 120);
    for (const Rgb& pixel : picture.pixels()) EXPECT_EQ(pixel, picture(0, 0));
  }
}

TEST(MapPicture, RejectsInvalidSizes) {
  EXPECT_THROW(draw_map(Points{{0, 0, 0}}, Colors(2), kSmall), DataError);
  EXPECT_THROW(draw_map({}, {}, {.width = 0, .height = 10}), DataError);
}

}  // namespace
}  // namespace mms
