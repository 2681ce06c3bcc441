#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mms/fusion/semantic_fusion.hpp"
#include "tests/fusion/scene.hpp"

namespace mms {
namespace {

using testing::mask_of;
using testing::render;
using testing::room_with_person;
using testing::Scene;
using testing::segmentation_of;
using testing::Surface;
using testing::View;

/// A LiDAR 0.3 m above and 0.1 m beside the camera, x forward, z up.
Transform<Camera, Lidar> extrinsics() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, -1, 0,  //
      0, 0, -1,            //
      1, 0, 0;
  T.translation() << 0.1, -0.3, 0.0;
  return Transform<Camera, Lidar>(T);
}

struct ScanView {
  Frame frame;
  std::vector<Surface> truth;
  Segmentation segmentation;
};

/// 48 rings from -25 to 10 degrees, with points 0.4 degrees apart over the full turn.
/// @param ring_step  of so many rings, one is kept
ScanView scan(const Scene& scene, int mask_grow, int ring_step = 1) {
  const View view = render(scene);
  ScanView result;
  auto calibration = std::make_shared<Calibration>(*view.frame.calibration);
  calibration->T_camera_lidar = extrinsics();
  result.frame.name = "scan";
  result.frame.calibration = calibration;
  result.frame.color = view.frame.color;
  result.segmentation = segmentation_of(view, {mask_of(view, Surface::kPerson, mask_grow)});
  const Eigen::Isometry3f T = extrinsics().isometry().cast<float>();
  constexpr float kDegree = std::numbers::pi_v<float> / 180.0F;
  for (int ring = 0; ring < 48; ring += ring_step) {
    const float elevation = (-25.0F + 35.0F * static_cast<float>(ring) / 47.0F) * kDegree;
    for (int step = 0; step < 900; ++step) {
      const float azimuth = (0.4F * static_cast<float>(step) + 0.01F) * kDegree;
      const Eigen::Vector3f direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const Scene::Hit hit = scene.cast(T.translation(), T.linear() * direction);
      if (hit.surface == Surface::kNone) continue;
      result.frame.scan.points.push_back(direction * hit.distance);
      result.truth.push_back(hit.surface);
    }
  }
  return result;
}

double dynamic_share_of(const LabeledCloud& cloud, const ScanView& view, Surface surface) {
  int count = 0;
  int dynamic = 0;
  for (std::size_t i = 0; i < view.truth.size(); ++i) {
    if (view.truth[i] != surface) continue;
    ++count;
    dynamic += cloud.labels[i] == PointLabel::kDynamic;
  }
  return static_cast<double>(dynamic) / count;
}

TEST(ScanFusion, TransfersMaskByExtrinsics) {
  const ScanView view = scan(room_with_person(), 0);
  const LabeledCloud cloud = SemanticFusion(FusionConfig{}).fuse(view.frame, view.segmentation);
  EXPECT_FALSE(cloud.organised());
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.97);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kWall), 0.001);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kFloor), 0.002);
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_NEAR(cloud.clusters[0].centroid.x(), 2.5F, 0.1F);
}

TEST(ScanFusion, ScalesIntensity) {
  ScanView view = scan(room_with_person(), 0);
  const auto intensity_of = [&](float low, float high) {
    view.frame.scan.intensity.assign(view.frame.scan.points.size(), low);
    view.frame.scan.intensity.back() = high;
    return SemanticFusion(FusionConfig{}).fuse(view.frame, view.segmentation).intensity;
  };
  EXPECT_EQ(intensity_of(0.2F, 1.0F).front(), 51);
  EXPECT_EQ(intensity_of(0.2F, 1.0F).back(), 255);
  EXPECT_EQ(intensity_of(30.0F, 900.0F).front(), 30);
  EXPECT_EQ(intensity_of(30.0F, 900.0F).back(), 255);
  EXPECT_EQ(intensity_of(std::nanf(""), 0.5F).front(), 0);
  view.frame.scan.intensity.clear();
  EXPECT_TRUE(SemanticFusion(FusionConfig{}).fuse(view.frame, view.segmentation).intensity.empty());
}

TEST(ScanFusion, DropsAPersonLargerThanARoom) {
  const Scene hall = Scene()
                         .add(Surface::kFloor, {-10, 1.2F, 0}, {10, 1.3F, 20})
                         .add(Surface::kWall, {-10, -5, 9}, {10, 1.2F, 9.1F})
                         .add(Surface::kPerson, {-0.25F, -0.5F, 2.5F}, {0.25F, 1.2F, 2.8F});
  ScanView view = scan(hall, 0);
  Instance& wrong = view.segmentation.instances.emplace_back();
  wrong.mask = Image<std::uint8_t>(view.segmentation.width, view.segmentation.height, 1);
  const LabeledCloud cloud = SemanticFusion(FusionConfig{}).fuse(view.frame, view.segmentation);
  EXPECT_EQ(cloud.implausible_masks, 1);
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.97);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kWall), 0.001);
}

TEST(ScanFusion, RingsTooFarApartForAClusterAreLabeledByMask) {
  const Scene hall = Scene()
                         .add(Surface::kFloor, {-10, 1.2F, 0}, {10, 1.3F, 20})
                         .add(Surface::kWall, {-10, -5, 15}, {10, 1.2F, 15.1F})
                         .add(Surface::kPerson, {-0.25F, -0.5F, 10.0F}, {0.25F, 1.2F, 10.3F});
  const ScanView view = scan(hall, 0, 3);
  const LabeledCloud cloud = SemanticFusion(FusionConfig{}).fuse(view.frame, view.segmentation);
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.9);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kWall), 0.001);
  ASSERT_EQ(cloud.clusters.size(), 1U) << "so that the person is tracked";
  EXPECT_NEAR(cloud.clusters[0].centroid.x(), 10.0F, 0.3F);
}

TEST(ScanFusion, RingsOnAPersonAreAnObjectBesideAPostBehind) {
  // The mask covers a part of the post, too.
  const Scene hall = Scene()
                         .add(Surface::kFloor, {-10, 1.2F, 0}, {10, 1.3F, 20})
                         .add(Surface::kWall, {-10, -5, 15}, {10, 1.2F, 15.1F})
                         .add(Surface::kOther, {0.3F, -5, 13.0F}, {0.42F, 1.2F, 13.1F})
                         .add(Surface::kPerson, {-0.25F, -0.5F, 10.0F}, {0.25F, 1.2F, 10.3F});
  const ScanView view = scan(hall, 4, 3);
  const LabeledCloud cloud = SemanticFusion(FusionConfig{}).fuse(view.frame, view.segmentation);
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.9);
  ASSERT_EQ(cloud.clusters.size(), 1U) << "so that the person is tracked";
  EXPECT_NEAR(cloud.clusters[0].centroid.x(), 10.0F, 0.3F);
}

TEST(ScanFusion, RestoresWallUnderDilatedMask) {
  const ScanView view = scan(room_with_person(), 15);
  const LabeledCloud cloud = SemanticFusion(FusionConfig{}).fuse(view.frame, view.segmentation);
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.97);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kWall), 0.001);
}

TEST(ScanFusion, VisionModeLabelsWallUnderMask) {
  const ScanView view = scan(room_with_person(), 15);
  FusionConfig config;
  config.mode = FusionMode::kVision;
  const LabeledCloud cloud = SemanticFusion(config).fuse(view.frame, view.segmentation);
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kWall), 0.001);
}

TEST(ScanFusion, AllStaticWithoutCamera) {
  ScanView view = scan(room_with_person(), 0);
  view.frame.calibration = std::make_shared<Calibration>();
  const LabeledCloud cloud = SemanticFusion(FusionConfig{}).fuse(view.frame, view.segmentation);
  EXPECT_EQ(dynamic_share(cloud), 0.0);
}

TEST(ScanFusion, LabelsBadPointsInvalidAndKeepsScanEmpty) {
  ScanView view = scan(room_with_person(), 0);
  constexpr float kInf = std::numeric_limits<float>::infinity();
  view.frame.scan.points[0] = Eigen::Vector3f(kInf, 0.0F, 0.0F);
  view.frame.scan.points[1] = Eigen::Vector3f::Constant(std::nanf(""));
  view.frame.scan.points[2] = Eigen::Vector3f::Zero();
  SemanticFusion fusion{FusionConfig{}};
  const LabeledCloud cloud = fusion.fuse(view.frame, view.segmentation);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(cloud.labels[i], PointLabel::kInvalid);
  view.frame.scan.points.clear();
  EXPECT_TRUE(fusion.fuse(view.frame, view.segmentation).points.empty());
}

TEST(ScanFusion, IsDeterministic) {
  const ScanView view = scan(room_with_person(), 3);
  SemanticFusion fusion{FusionConfig{}};
  const LabeledCloud a = fusion.fuse(view.frame, view.segmentation);
  const LabeledCloud b = fusion.fuse(view.frame, view.segmentation);
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.cluster, b.cluster);
}

}  // namespace
}  // namespace mms
