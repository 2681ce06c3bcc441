#include "mms/localization/photometric/still_camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mms {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
const DepthNoise kNoise;

struct View {
  double shift = 0.0;     ///< of the image to the left [px]
  double exposure = 0.0;  ///< added to the intensity
  int changed = 0;        ///< columns that show something else
  double other = 7.3;     ///< shift of that [px]
  int masked = 0;         ///< columns of dynamic pixels, on the right
  bool stripes = false;   ///< horizontal ones instead of both directions
  double depth = 2.0;     ///< [m]
};

double texture(double x, double y, bool stripes) {
  const double along_y = std::sin(0.55 * y);
  return 128.0 + 60.0 * along_y + (stripes ? 0.0 : 60.0 * std::sin(0.5 * x + 0.2 * y));
}

/// A textured wall.
IntensityLevel wall(const View& view) {
  IntensityLevel level{{150.0, 150.0, 80.0, 60.0, kWidth, kHeight, {}},
                       Image<IntensitySample>(kWidth, kHeight),
                       Image<float>(kWidth, kHeight, static_cast<float>(view.depth))};
  const auto value = [&](int x, int y) {
    const double offset = x < view.changed ? view.other : view.shift;
    return static_cast<float>(view.exposure + texture(x + offset, y, view.stripes));
  };
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      level.intensity(x, y) = {value(x, y), 0.5F * (value(x + 1, y) - value(x - 1, y)),
                               0.5F * (value(x, y + 1) - value(x, y - 1))};
      if (x >= kWidth - view.masked) level.depth(x, y) = 0.0F;
    }
  }
  return level;
}

bool same(const View& before, const View& now) {
  return show_same_view(wall(before), wall(now), kNoise);
}

TEST(StillView, IsTheSameWithoutMotion) {
  EXPECT_TRUE(same({}, {}));
  EXPECT_TRUE(same({}, {.shift = 0.1}));
  EXPECT_TRUE(same({}, {.exposure = 25.0}));
}

TEST(StillView, DiffersWhereTheCameraMoves) {
  for (const double shift : {-1.0, -0.6, 0.6, 1.0, 3.0}) {
    EXPECT_FALSE(same({}, {.shift = shift})) << shift;
  }
  EXPECT_FALSE(same({}, {.depth = 2.1})) << "towards the wall";
}

TEST(StillView, IgnoresWhatCoversLessThanHalf) {
  EXPECT_TRUE(same({}, {.changed = kWidth * 4 / 10}));
  EXPECT_FALSE(same({}, {.changed = kWidth * 7 / 10}));
  EXPECT_TRUE(same({}, {.changed = kWidth * 3 / 10, .masked = kWidth * 2 / 10}));
}

TEST(StillView, DiffersFromViewWithoutTexture) {
  IntensityLevel blank = wall({});
  blank.intensity = Image<IntensitySample>(kWidth, kHeight, {128.0F, 0.0F, 0.0F});
  EXPECT_FALSE(show_same_view(wall({}), blank, kNoise));
}

TEST(StillView, NeedsTextureInBothDirections) {
  EXPECT_FALSE(same({.stripes = true}, {.stripes = true}));
  EXPECT_FALSE(same({}, {.masked = kWidth}));
}

Eigen::Isometry3d at(double x) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0));
}

/// Follows a view at a pose, and returns the pose at which the camera stands still before, if any.
std::optional<double> follow(StillCamera& camera, const View& view, double estimated) {
  const std::vector<IntensityLevel> image = {wall(view)};
  const auto pose = camera.pose(image, at(estimated));
  camera.follow(image, pose.value_or(at(estimated)));
  return pose ? std::optional(pose->translation().x()) : std::nullopt;
}

TEST(StillCamera, HoldsPoseFromFourthSameViewOn) {
  StillCamera camera{kNoise};
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(follow(camera, {}, 1.0 + 0.001 * i)) << i;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(follow(camera, {}, 1.01 + 0.005 * i), 1.0) << i;
}

TEST(StillCamera, FollowsSlowMotion) {
  StillCamera camera{kNoise};
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(follow(camera, {.shift = 0.2 * i}, 0.001 * i)) << i;
}

TEST(StillCamera, FindsItsPoseAgainAfterPeopleCoveredTheView) {
  StillCamera camera{kNoise};
  for (int i = 0; i < 5; ++i) follow(camera, {}, 0.0);
  for (int i = 0; i < 5; ++i) {
    const View people{.changed = kWidth * 3 / 4, .other = 7.3 + i};
    EXPECT_FALSE(follow(camera, people, 0.008 * i));
  }
  EXPECT_EQ(follow(camera, {}, 0.04), 0.0);
}

TEST(StillCamera, LeavesPoseWhereTheEstimateIsFarAway) {
  StillCamera camera{kNoise};
  for (int i = 0; i < 5; ++i) follow(camera, {}, 0.0);
  EXPECT_FALSE(follow(camera, {}, 0.06));
  EXPECT_FALSE(camera.pose({}, at(0.0))) << "without an image";
  camera.forget();
  EXPECT_FALSE(follow(camera, {}, 0.0));
}

}  // namespace
}  // namespace mms
