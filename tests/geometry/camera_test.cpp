#include "mms/geometry/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "mms/core/error.hpp"

namespace mms {
namespace {

CameraIntrinsics pinhole() {
  return {.fx = 517.3, .fy = 516.5, .cx = 318.6, .cy = 255.3, .width = 640, .height = 480};
}

CameraIntrinsics tum_fr1() {
  CameraIntrinsics camera = pinhole();
  camera.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  return camera;
}

class EveryCamera : public ::testing::TestWithParam<CameraIntrinsics> {};
INSTANTIATE_TEST_SUITE_P(Camera, EveryCamera, ::testing::Values(pinhole(), tum_fr1()));

TEST_P(EveryCamera, ProjectInvertsRay) {
  const CameraModel camera(GetParam());
  for (int y = 0; y < 480; y += 7) {
    for (int x = 0; x < 640; x += 7) {
      const Eigen::Vector3d ray = camera.ray({x, y});
      EXPECT_EQ(ray.z(), 1.0);
      EXPECT_TRUE(camera.in_lens_range(ray)) << x << " " << y;
      EXPECT_LT((camera.project(3.7 * ray) - Eigen::Vector2d(x, y)).norm(), 1e-8) << x << " " << y;
    }
  }
}

TEST_P(EveryCamera, JacobianEqualsNumericDerivative) {
  const CameraModel camera(GetParam());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p =
        (0.5 + 6.0 * unit(random)) * camera.ray({640.0 * unit(random), 480.0 * unit(random)});
    Eigen::Matrix<double, 2, 3> analytic;
    EXPECT_LT((camera.project(p, analytic) - camera.project(p)).norm(), 1e-10);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(k);
      const Eigen::Vector2d numeric = (camera.project(p + step) - camera.project(p - step)) / 2e-6;
      EXPECT_LT((analytic.col(k) - numeric).norm(), 1e-5 * (1.0 + numeric.norm()));
    }
  }
}

TEST_P(EveryCamera, RayTableIsRowMajor) {
  const CameraModel camera(downscaled(GetParam(), 8));
  const auto table = camera.ray_table();
  ASSERT_EQ(table.size(), 80U * 60U);
  for (const auto& [x, y] : {std::pair{0, 0}, {79, 0}, {0, 59}, {31, 17}, {79, 59}}) {
    const auto index = static_cast<std::size_t>(80 * y + x);
    EXPECT_TRUE(table[index].isApprox(camera.ray({x, y}).cast<float>(), 1e-6F));
  }
}

TEST_P(EveryCamera, DownscaledProjectionMatchesFull) {
  const CameraModel full(GetParam());
  for (const int stride : {2, 3, 4, 8}) {
    const CameraModel small(downscaled(GetParam(), stride));
    EXPECT_EQ(small.intrinsics().width, 640 / stride);
    EXPECT_EQ(small.intrinsics().height, 480 / stride);
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(3, 5), {200, 100}, {600, 470}}) {
      // The block of pixels k*stride ... k*stride + stride - 1 has its center at pixel k.
      const Eigen::Vector2d in_full = full.project(2.0 * full.ray(pixel));
      const Eigen::Vector2d in_small = small.project(2.0 * full.ray(pixel));
      const Eigen::Vector2d expected =
          (in_full - Eigen::Vector2d::Constant(0.5 * (stride - 1))) / stride;
      EXPECT_LT((in_small - expected).norm(), 1e-9) << stride;
    }
  }
}

/// OpenCV's distortion model as documented.
TEST(Camera, DistortionEqualsOpenCv) {
  const CameraIntrinsics c = tum_fr1();
  const auto [k1, k2, p1, p2, k3] = c.distortion;
  for (const auto& [x, y] : {std::pair{0.3, -0.2}, {-0.55, 0.4}, {0.1, 0.45}}) {
    const double r2 = x * x + y * y;
    const double radial = 1.0 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2;
    const double xd = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x);
    const double yd = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
    const Eigen::Vector2d expected(c.fx * xd + c.cx, c.fy * yd + c.cy);
    EXPECT_LT((CameraModel(c).project({2.0 * x, 2.0 * y, 2.0}) - expected).norm(), 1e-10);
  }
}

TEST(Camera, PointsBehindOrOffAxisAreOutOfRange) {
  CameraIntrinsics barrel = pinhole();
  barrel.distortion[0] = -0.4;  // r (1 - 0.4 r^2) turns back at r = 0.913
  const CameraModel camera(barrel);
  EXPECT_TRUE(camera.in_lens_range({0.8, 0.0, 1.0}));
  EXPECT_FALSE(camera.in_lens_range({1.0, 0.0, 1.0}));
  EXPECT_FALSE(camera.in_lens_range({0.0, 0.0, -1.0}));
  EXPECT_FALSE(camera.in_lens_range({0.0, 0.0, 0.0}));
  // Its projection folds back into the image.
  EXPECT_TRUE((camera.project({1.5, 0.0, 1.0}).array() > 0.0).all());
  EXPECT_FALSE(camera.in_lens_range({1.5, 0.0, 1.0}));
}

TEST(Camera, RejectsInvalidIntrinsics) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const auto with = [](auto change) {
    CameraIntrinsics camera = pinhole();
    change(camera);
    return CameraModel(camera);
  };
  for (const double bad : {0.0, -500.0, nan, inf}) {
    EXPECT_THROW(with([&](auto& c) { c.fx = bad; }), DataError);
    EXPECT_THROW(with([&](auto& c) { c.fy = bad; }), DataError);
  }
  for (const double bad : {nan, inf}) {
    EXPECT_THROW(with([&](auto& c) { c.cx = bad; }), DataError);
    EXPECT_THROW(with([&](auto& c) { c.cy = bad; }), DataError);
    EXPECT_THROW(with([&](auto& c) { c.distortion[3] = bad; }), DataError);
  }
  for (const int bad : {0, -1, 1'000'000}) {
    EXPECT_THROW(with([&](auto& c) { c.width = bad; }), DataError);
    EXPECT_THROW(with([&](auto& c) { c.height = bad; }), DataError);
  }
  EXPECT_NO_THROW(with([](auto&) {}));
}

}  // namespace
}  // namespace mms
