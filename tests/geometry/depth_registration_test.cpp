#include "mms/geometry/depth_registration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mms {
namespace {

/// Depth of a slanted wall with a board 1 m before it, seen by a camera; exact.
Image<float> render(const CameraIntrinsics& intrinsics, const Eigen::Isometry3d& T_world_camera) {
  const CameraModel camera(intrinsics);
  Image<float> depth(intrinsics.width, intrinsics.height);
  const Eigen::Vector3d wall(0.2, 0.1, -1.0);
  const Eigen::Vector3d origin = T_world_camera.translation();
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      // A ray with z = 1, so that its length is the depth.
      const Eigen::Vector3d ray = T_world_camera.linear() * camera.ray(Eigen::Vector2d(x, y));
      double z = (-3.0 - wall.dot(origin)) / wall.dot(ray);
      const double board = (2.0 - origin.z()) / ray.z();
      const Eigen::Vector3d at = origin + board * ray;
      if (std::abs(at.x()) < 0.3 && std::abs(at.y()) < 0.4) z = board;
      depth(x, y) = static_cast<float>(z);
    }
  }
  return depth;
}

DepthCamera make_depth_camera(int width, int height) {
  DepthCamera depth;
  const double f = 0.8 * width;
  depth.camera = {f, f, 0.5 * width - 0.5, 0.5 * height - 0.5, width, height, {}};
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(0.05, -0.01, 0.004);
  T.linear() =
      Eigen::AngleAxisd(0.02, Eigen::Vector3d(0.3, 1.0, 0.2).normalized()).toRotationMatrix();
  depth.T_color_depth = Transform<Camera, Depth>(T);
  return depth;
}

const CameraIntrinsics kColor{300, 305, 158, 121, 320, 240, {0.05, -0.02, 0.001, -0.001, 0}};

/// Shares of the color pixels that the depth camera sees, too.
struct Shares {
  double filled = 0.0;   ///< with a depth
  double correct = 0.0;  ///< of those, within 1 cm of the truth
};

Shares compare(const Image<float>& registered, const Image<float>& truth) {
  Shares shares;
  int seen = 0;
  int filled = 0;
  int correct = 0;
  // A margin that both cameras see.
  for (int y = 30; y < truth.height() - 30; ++y) {
    for (int x = 40; x < truth.width() - 40; ++x) {
      ++seen;
      if (registered(x, y) == 0.0F) continue;
      ++filled;
      if (std::abs(registered(x, y) - truth(x, y)) < 0.01F) ++correct;
    }
  }
  shares.filled = static_cast<double>(filled) / seen;
  shares.correct = static_cast<double>(correct) / filled;
  return shares;
}

TEST(DepthRegistration, GivesDepthOfColorCameraAtAnyResolution) {
  const Image<float> truth = render(kColor, Eigen::Isometry3d::Identity());
  for (const int width : {160, 320, 848}) {
    const DepthCamera depth = make_depth_camera(width, width * 3 / 4);
    const DepthRegistration registration(depth, kColor);
    const Image<float> registered =
        registration.apply(render(depth.camera, depth.T_color_depth.isometry()));
    ASSERT_EQ(registered.width(), kColor.width);
    const Shares shares = compare(registered, truth);
    // The shadow of the board is 5 cm * 300 px * (1/2 m - 1/3 m) = 2.5 px wide and 120 px high.
    EXPECT_GT(shares.filled, 0.98) << width;
    EXPECT_GT(shares.correct, width < 320 ? 0.97 : 0.985) << width;
    // Without registration most depths are of the board's or another place.
    if (width == 320) {
      EXPECT_LT(compare(render(depth.camera, depth.T_color_depth.isometry()), truth).correct, 0.4);
    }
  }
}

TEST(DepthRegistration, LeavesShadowEmptyBesideNearObjects) {
  const DepthCamera depth = make_depth_camera(320, 240);
  const DepthRegistration registration(depth, kColor);
  const Image<float> registered =
      registration.apply(render(depth.camera, depth.T_color_depth.isometry()));
  int empty = 0;
  for (int x = 40; x < 280; ++x) empty += registered(x, 120) == 0.0F ? 1 : 0;
  EXPECT_GE(empty, 1);
  EXPECT_LE(empty, 4);
}

TEST(DepthRegistration, SkipsPixelsWithoutReturn) {
  const DepthCamera depth = make_depth_camera(320, 240);
  Image<float> image(320, 240, 0.0F);
  image(100, 100) = std::nanf("");
  image(120, 100) = std::numeric_limits<float>::infinity();
  image(140, 100) = -1.0F;
  image(160, 120) = 2.0F;
  const Image<float> registered = DepthRegistration(depth, kColor).apply(image);
  int filled = 0;
  for (std::size_t i = 0; i < registered.size(); ++i) filled += registered[i] > 0.0F ? 1 : 0;
  EXPECT_GE(filled, 1);
  EXPECT_LE(filled, 4);
}

TEST(DepthRegistration, CalibrationOfFramesHasNoDepthCamera) {
  auto calibration = std::make_shared<Calibration>();
  calibration->camera = kColor;
  EXPECT_FALSE(make_registration(*calibration));
  calibration->depth_camera = make_depth_camera(320, 240);
  EXPECT_TRUE(make_registration(*calibration));
  EXPECT_FALSE(registered_calibration(calibration)->depth_camera);
}

}  // namespace
}  // namespace mms
