#include "mms/geometry/camera.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mms/core/error.hpp"
#include "mms/core/image.hpp"

namespace mms {
namespace {

/// Distorted normalized coordinates and, if requested, their 2x2 derivative.
Eigen::Vector2d distort(const std::array<double, 5>& k, const Eigen::Vector2d& p,
                        Eigen::Matrix2d* jacobian) {
  const auto [k1, k2, p1, p2, k3] = k;
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  if (jacobian != nullptr) {
    const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));
    const double cross = slope * x * y + 2.0 * (p1 * x + p2 * y);
    *jacobian << radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x, cross,  //
        cross, radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
  }
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

/// Squared radius up to which r * radial(r^2) is monotonic and therefore invertible.
double monotonic_radius2(const std::array<double, 5>& k, double limit2) {
  const auto grows = [&](double r2) {
    return 1.0 + r2 * (3.0 * k[0] + r2 * (5.0 * k[1] + r2 * 7.0 * k[4])) > 0.05;
  };
  constexpr int kSteps = 400;
  for (int i = 1; i <= kSteps; ++i) {
    const double r2 = limit2 * i / kSteps;
    if (!grows(r2)) return limit2 * (i - 1) / kSteps;
  }
  return limit2;
}

void check(const CameraIntrinsics& c) {
  const auto fail = [](const std::string& key, double value, const std::string& range) {
    throw DataError("calibration", key + " is " + std::to_string(value) + ", allowed: " + range,
                    "give fx fy cx cy width height in pixels");
  };
  if (!(c.fx > 0.0) || !std::isfinite(c.fx)) fail("fx", c.fx, "> 0");
  if (!(c.fy > 0.0) || !std::isfinite(c.fy)) fail("fy", c.fy, "> 0");
  if (!std::isfinite(c.cx)) fail("cx", c.cx, "a finite number");
  if (!std::isfinite(c.cy)) fail("cy", c.cy, "a finite number");
  const std::string sides = "1 to " + std::to_string(kMaxImageSide);
  if (c.width < 1 || c.width > kMaxImageSide) fail("width", c.width, sides);
  if (c.height < 1 || c.height > kMaxImageSide) fail("height", c.height, sides);
  for (const double k : c.distortion) {
    if (!std::isfinite(k)) fail("distortion", k, "five finite numbers");
  }
}

}  // namespace

CameraModel::CameraModel(const CameraIntrinsics& intrinsics) : intrinsics_(intrinsics) {
  check(intrinsics);
  const auto& k = intrinsics.distortion;
  distorted_ = std::any_of(k.begin(), k.end(), [](double value) { return value != 0.0; });
  const double half_x = std::max(intrinsics.cx, intrinsics.width - intrinsics.cx) / intrinsics.fx;
  const double half_y = std::max(intrinsics.cy, intrinsics.height - intrinsics.cy) / intrinsics.fy;
  const double corner2 = 2.0 * (half_x * half_x + half_y * half_y);
  max_radius2_ = distorted_ ? monotonic_radius2(k, corner2) : corner2;
}

bool CameraModel::in_lens_range(const Eigen::Vector3d& point) const {
  return point.z() > 0.0 && point.head<2>().squaredNorm() <= max_radius2_ * point.z() * point.z();
}

Eigen::Vector2d CameraModel::project(const Eigen::Vector3d& point) const {
  Eigen::Vector2d p = point.head<2>() / point.z();
  if (distorted_) p = distort(intrinsics_.distortion, p, nullptr);
  return {intrinsics_.fx * p.x() + intrinsics_.cx, intrinsics_.fy * p.y() + intrinsics_.cy};
}

Eigen::Vector2d CameraModel::project(const Eigen::Vector3d& point,
                                     Eigen::Matrix<double, 2, 3>& jacobian) const {
  const double inverse_z = 1.0 / point.z();
  Eigen::Vector2d p = point.head<2>() * inverse_z;
  jacobian << inverse_z, 0.0, -p.x() * inverse_z, 0.0, inverse_z, -p.y() * inverse_z;
  if (distorted_) {
    Eigen::Matrix2d lens;
    p = distort(intrinsics_.distortion, p, &lens);
    jacobian = (lens * jacobian).eval();
  }
  jacobian.row(0) *= intrinsics_.fx;
  jacobian.row(1) *= intrinsics_.fy;
  return {intrinsics_.fx * p.x() + intrinsics_.cx, intrinsics_.fy * p.y() + intrinsics_.cy};
}

Eigen::Vector3d CameraModel::ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d target((pixel.x() - intrinsics_.cx) / intrinsics_.fx,
                               (pixel.y() - intrinsics_.cy) / intrinsics_.fy);
  Eigen::Vector2d p = target;
  if (distorted_) {
    for (int i = 0; i < 20; ++i) {
      Eigen::Matrix2d lens;
      const Eigen::Vector2d error = distort(intrinsics_.distortion, p, &lens) - target;
      if (error.squaredNorm() < 1e-24) break;
      p -= lens.inverse() * error;
    }
  }
  return {p.x(), p.y(), 1.0};
}

std::vector<Eigen::Vector3f> CameraModel::ray_table() const {
  std::vector<Eigen::Vector3f> rays;
  rays.reserve(static_cast<std::size_t>(intrinsics_.width) *
               static_cast<std::size_t>(intrinsics_.height));
  for (int y = 0; y < intrinsics_.height; ++y) {
    for (int x = 0; x < intrinsics_.width; ++x) rays.push_back(ray({x, y}).cast<float>());
  }
  return rays;
}

CameraIntrinsics downscaled(const CameraIntrinsics& camera, int stride) {
  CameraIntrinsics small = camera;
  small.width = camera.width / stride;
  small.height = camera.height / stride;
  small.fx = camera.fx / stride;
  small.fy = camera.fy / stride;
  small.cx = (camera.cx + 0.5) / stride - 0.5;
  small.cy = (camera.cy + 0.5) / stride - 0.5;
  return small;
}

}  // namespace mms
