#include "mms/localization/photometric/photometric_term.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "mms/geometry/camera.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::motion;

/// TUM's fr1 camera at a quarter of its size.
CameraIntrinsics distorted_camera() {
  CameraIntrinsics camera{
      .fx = 517.3, .fy = 516.5, .cx = 318.6, .cy = 255.3, .width = 640, .height = 480};
  camera.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  return downscaled(camera, 4);
}

using Pattern = std::function<double(double x, double y)>;

/// A level with that luminance, its central differences and constant depth.
IntensityLevel level_of(const Pattern& pattern, float depth) {
  const CameraIntrinsics camera = distorted_camera();
  IntensityLevel level{camera, Image<IntensitySample>(camera.width, camera.height),
                       Image<float>(camera.width, camera.height, depth)};
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      level.intensity(x, y) = {static_cast<float>(pattern(x, y)),
                               static_cast<float>(0.5 * (pattern(x + 1, y) - pattern(x - 1, y))),
                               static_cast<float>(0.5 * (pattern(x, y + 1) - pattern(x, y - 1)))};
    }
  }
  return level;
}

/// Gradient large enough everywhere, with little curvature.
double slope(double x, double y) {
  return 20.0 + 0.6 * x + 0.5 * y + 0.002 * x * x - 0.001 * x * y + 0.0015 * y * y;
}

double waves(double x, double y) {
  return 128.0 + 50.0 * std::sin(0.22 * x + 0.05 * y) + 40.0 * std::sin(0.25 * y - 0.04 * x);
}

PhotometricConfig plain_config() {
  PhotometricConfig config;
  config.min_gradient = 0.5;
  return config;
}

/// A sigma so large that the robust weight is the same for all residuals.
PhotometricState without_robustness(double bias = 0.0) {
  return {.gain = 1.0, .bias = bias, .sigma = 1e6};
}

TEST(PhotometricTerm, JacobianEqualsNumericDerivative) {
  const IntensityLevel level = level_of(slope, 2.0F);
  const PhotometricConfig config = plain_config();
  const Eigen::Isometry3d T = motion(0.01, -0.02, 0.015, 0.01, 0.008, -0.02);
  const PhotometricState state = without_robustness(-300.0);  // residuals near 300, never 0
  const CameraModel camera(level.camera);
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(20, 15), {130, 25}, {80, 60}, {25, 100}}) {
    IntensityKeyframe keyframe;
    keyframe.levels = {{{(2.0 * camera.ray(pixel)).cast<float>(),
                         static_cast<float>(slope(pixel.x(), pixel.y()))}}};
    const auto at = [&](const Eigen::Isometry3d& pose) {
      return photometric_equations(keyframe, 0, level, pose, state, config, DepthNoise{});
    };
    const double weight = 1.2 / (state.sigma * state.sigma);
    const auto residual = [&](const Eigen::Isometry3d& pose) {
      return std::sqrt(at(pose).equations.cost / weight);
    };
    ASSERT_EQ(at(T).visible, 1);
    const Vector6d analytic = at(T).equations.gradient / (weight * residual(T));
    Vector6d numeric;
    for (int k = 0; k < 6; ++k) {
      const Vector6d step = 2e-3 * Vector6d::Unit(k);
      numeric(k) = (residual(T * se3::exp(step)) - residual(T * se3::exp(-step))) / 4e-3;
    }
    EXPECT_LT((analytic - numeric).norm(), 0.01 * numeric.norm()) << pixel.transpose();
    const Matrix6d outer = weight * analytic * analytic.transpose();
    EXPECT_LT((at(T).equations.information - outer).norm(), 1e-4 * outer.norm());
  }
}

TEST(PhotometricTerm, ResidualsVanishAtTruePose) {
  const IntensityLevel level = level_of(waves, 2.0F);
  const Eigen::Isometry3d pose = motion(1.0, 2.0, 3.0, 0.3, 0.2, 0.1);
  const auto keyframe = make_intensity_keyframe({level}, pose, plain_config(), DepthNoise{});
  ASSERT_GT(keyframe.levels.at(0).size(), 1000U);
  const auto sum =
      photometric_equations(keyframe, 0, level, pose, {}, plain_config(), DepthNoise{});
  EXPECT_GT(sum.visible, static_cast<int>(keyframe.levels[0].size()) * 9 / 10);
  EXPECT_EQ(sum.histogram[0], static_cast<std::uint32_t>(sum.visible));
}

TEST(PhotometricTerm, RecoversGainAndBias) {
  const auto keyframe = make_intensity_keyframe(
      {level_of(waves, 2.0F)}, Eigen::Isometry3d::Identity(), plain_config(), DepthNoise{});
  const IntensityLevel brighter =
      level_of([](double x, double y) { return 1.15 * waves(x, y) - 12.0; }, 2.0F);
  PhotometricState state;
  for (int i = 0; i < 10; ++i) {
    const auto sum = photometric_equations(keyframe, 0, brighter, Eigen::Isometry3d::Identity(),
                                           state, plain_config(), DepthNoise{});
    state = sum.next(state, plain_config().min_sigma);
  }
  EXPECT_NEAR(state.gain, 1.15, 0.005);
  EXPECT_NEAR(state.bias, -12.0, 0.5);
  EXPECT_EQ(state.sigma, plain_config().min_sigma);
}

TEST(PhotometricTerm, SigmaFollowsMedianResidual) {
  PhotometricEquations equations;  // |residual| evenly over 0 ... 20: median 10
  equations.visible = 2000;
  for (std::size_t bin = 0; bin < 20; ++bin) equations.histogram[bin] = 100;
  equations.sw = 1.0;
  EXPECT_NEAR(equations.next({}, 1.0).sigma, 1.4826 * 10.0, 1e-9);
  EXPECT_EQ(equations.next({}, 50.0).sigma, 50.0);
  const PhotometricState before{.gain = 1.1, .bias = 2.0, .sigma = 7.0};
  EXPECT_EQ(PhotometricEquations{}.next(before, 1.0).sigma, 7.0);
  EXPECT_EQ(PhotometricEquations{}.next(before, 1.0).gain, 1.1);
}

/// Number of visible keyframe points when the left half of the view has another depth.
int visible_with_left_half_at(float depth) {
  const IntensityLevel level = level_of(waves, 2.0F);
  const auto keyframe =
      make_intensity_keyframe({level}, Eigen::Isometry3d::Identity(), plain_config(), DepthNoise{});
  IntensityLevel current = level;
  for (int y = 0; y < current.depth.height(); ++y) {
    for (int x = 0; x < current.depth.width() / 2; ++x) current.depth(x, y) = depth;
  }
  return photometric_equations(keyframe, 0, current, Eigen::Isometry3d::Identity(), {},
                               plain_config(), DepthNoise{})
      .visible;
}

TEST(PhotometricTerm, IgnoresOccludedPoints) {
  const int all = visible_with_left_half_at(2.0F);
  const int hidden = visible_with_left_half_at(1.2F);
  EXPECT_NEAR(hidden, all / 2, all / 20);
  EXPECT_EQ(visible_with_left_half_at(0.0F), hidden);  // dynamic or no return
  EXPECT_EQ(visible_with_left_half_at(2.8F), hidden);  // the keyframe's surface is gone
  EXPECT_EQ(visible_with_left_half_at(2.01F), all);    // noise
}

TEST(PhotometricTerm, IgnoresPointsOutsideImage) {
  const IntensityLevel level = level_of(waves, 2.0F);
  const auto keyframe =
      make_intensity_keyframe({level}, Eigen::Isometry3d::Identity(), plain_config(), DepthNoise{});
  const auto visible_from = [&](const Eigen::Isometry3d& T) {
    return photometric_equations(keyframe, 0, level, T, {}, plain_config(), DepthNoise{}).visible;
  };
  EXPECT_EQ(visible_from(motion(0, 0, 0, 0, M_PI, 0)), 0);
  EXPECT_EQ(visible_from(motion(50, 0, 0, 0, 0, 0)), 0);
  const int all = visible_from(Eigen::Isometry3d::Identity());
  const int half = visible_from(motion(1.24, 0, 0, 0, 0, 0));  // half the view of 2.47 m
  EXPECT_NEAR(half, all / 2, all / 10);
}

TEST(IntensityKeyframe, ExcludesDynamicPixelsAndDepthEdges) {
  IntensityLevel level = level_of(waves, 2.0F);
  const CameraModel camera(level.camera);
  const auto fill = [&](int left, int right, float depth) {
    for (int y = 0; y < level.depth.height(); ++y) {
      for (int x = left; x < right; ++x) level.depth(x, y) = depth;
    }
  };
  fill(0, 40, 0.0F);
  fill(100, 160, 4.0F);
  const auto keyframe =
      make_intensity_keyframe({level}, Eigen::Isometry3d::Identity(), plain_config(), DepthNoise{});
  ASSERT_GT(keyframe.levels[0].size(), 500U);
  for (const TexturedPoint& p : keyframe.levels[0]) {
    const double x = camera.project(p.point.cast<double>()).x();
    EXPECT_GE(x, 39.99);
    EXPECT_GT(std::abs(x - 99.5), 1.5);
    EXPECT_NEAR(p.point.z(), x < 99.5 ? 2.0F : 4.0F, 1e-4F);
    const Eigen::Vector2d pixel = camera.project(p.point.cast<double>());
    EXPECT_NEAR(static_cast<double>(p.intensity), waves(pixel.x(), pixel.y()), 0.01);
  }
}

TEST(IntensityKeyframe, IsEmptyWithoutTexture) {
  const IntensityLevel flat = level_of([](double, double) { return 100.0; }, 2.0F);
  const auto keyframe =
      make_intensity_keyframe({flat}, Eigen::Isometry3d::Identity(), {}, DepthNoise{});
  EXPECT_TRUE(keyframe.levels.at(0).empty());
}

}  // namespace
}  // namespace mms
