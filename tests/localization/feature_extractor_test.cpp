#include "mms/localization/features/feature_extractor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "mms/geometry/camera.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::BoxRoom;
using testing::motion;

const Eigen::Isometry3d kOrigin = Eigen::Isometry3d::Identity();

/// Cloud of the box camera with that depth of each pixel; 0 for no return.
LabeledCloud cloud_with_depth(
    const std::function<double(int, int, const Eigen::Vector3d&)>& depth_of) {
  LabeledCloud cloud = testing::organised_cloud(BoxRoom{}, kOrigin);
  const CameraModel camera(cloud.camera);
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const auto i = static_cast<std::size_t>(y * cloud.width + x);
      const double z = depth_of(x, y, camera.ray({x, y}));
      cloud.points[i] = (z * camera.ray({x, y})).cast<float>();
      if (z > 0.0) continue;
      cloud.points[i].setConstant(NAN);
      cloud.labels[i] = PointLabel::kInvalid;
    }
  }
  return cloud;
}

FeatureCloud extract(const LabeledCloud& cloud) {
  return FeatureExtractor(FeatureConfig{}).extract(cloud);
}

/// Pose of a camera with floor, two walls and their creases in view.
const Eigen::Isometry3d kTowardCorner = motion(0.3, -0.2, 0.5, -0.25, -0.5, 0.1);

/// Largest distance of a crease from a point with the crease in its neighborhood of eq. (2), on a
/// surface without a grazing angle [m].
double max_crease_distance(const EdgeFeature& edge) {
  const double window = 4.0 * std::sqrt(2.0) / testing::box_camera().fx;  // at 1 m
  return 1.5 * window * static_cast<double>(edge.point.norm());
}

TEST(OrganisedFeatures, EdgesAreAtCreasesAndPlanesOnFaces) {
  const BoxRoom room;
  const FeatureCloud features = extract(testing::organised_cloud(room, kTowardCorner));
  EXPECT_GT(features.planes.size(), 300U);
  EXPECT_GT(features.edges.size(), 20U);
  for (const EdgeFeature& edge : features.edges) {
    EXPECT_LT(room.distance_to_crease(kTowardCorner * edge.point.cast<double>()),
              max_crease_distance(edge));
  }
  for (const PlaneFeature& plane : features.planes) {
    const Eigen::Vector3d p = kTowardCorner * plane.point.cast<double>();
    // At a crease a plane may be fitted to both faces, within the noise.
    EXPECT_LT(room.distance_to_face(p), 2.0 * DepthNoise{}.sigma(plane.point.cast<double>().z()));
    EXPECT_NEAR(static_cast<double>(plane.normal.norm()), 1.0, 1e-5);
    if (room.distance_to_crease(p) < 0.4) continue;
    const Eigen::Vector3d view = p - kTowardCorner.translation();
    const Eigen::Vector3d truth = room.cast(kTowardCorner.translation(), view).normal;
    EXPECT_LT(room.distance_to_face(p), 1e-4);
    EXPECT_GT(truth.dot(kTowardCorner.linear() * plane.normal.cast<double>()), 0.9999);
  }
}

/// Half the camera's noise: that of the mean of a 2 x 2 block of pixels.
TEST(OrganisedFeatures, NoiseCausesFewFalseEdges) {
  const BoxRoom room;
  const FeatureCloud features = extract(testing::organised_cloud(room, kTowardCorner, 0.5, 3));
  const auto false_edges =
      std::count_if(features.edges.begin(), features.edges.end(), [&](const EdgeFeature& edge) {
        return room.distance_to_crease(kTowardCorner * edge.point.cast<double>()) >
               max_crease_distance(edge);
      });
  EXPECT_LT(false_edges, static_cast<int>(features.edges.size() / 4));
  EXPECT_GT(features.edges.size(), 20U);
  EXPECT_GT(features.planes.size(), 300U);
}

TEST(OrganisedFeatures, AreDistributedOverImage) {
  const FeatureCloud features = extract(testing::organised_cloud(BoxRoom{}, kOrigin));
  const CameraModel camera(testing::box_camera());
  std::array<int, 12> tiles{};  // 4 x 3 tiles of 40 pixels
  for (const PlaneFeature& plane : features.planes) {
    const Eigen::Vector2d pixel = camera.project(plane.point.cast<double>());
    ++tiles.at(static_cast<std::size_t>(pixel.y() / 40) * 4 +
               static_cast<std::size_t>(pixel.x() / 40));
  }
  EXPECT_GT(*std::min_element(tiles.begin(), tiles.end()), 10);
}

/// With two planes in each of the 300 sectors of 8 px there were 600.
TEST(OrganisedFeatures, ComeFromSmallerSectorsInSmallImages) {
  const LabeledCloud cloud = testing::organised_cloud(BoxRoom{}, kOrigin);
  ASSERT_EQ(cloud.width * cloud.height, 160 * 120);
  EXPECT_GT(extract(cloud).planes.size(), 1000U);
}

TEST(OrganisedFeatures, ExcludeOcclusionBorders) {
  const auto board_and_wall = cloud_with_depth([](int x, int y, const Eigen::Vector3d&) {
    return x >= 50 && x < 110 && y >= 40 && y < 90 ? 2.0 : 4.0;
  });
  const FeatureCloud features = extract(board_and_wall);
  EXPECT_TRUE(features.edges.empty());
  ASSERT_GT(features.planes.size(), 200U);
  for (const PlaneFeature& plane : features.planes) {
    const float z = plane.point.z();
    EXPECT_LT(std::min(std::abs(z - 2.0F), std::abs(z - 4.0F)), 1e-4F);
    EXPECT_LT(plane.normal.z(), -0.9999F);
  }
}

TEST(OrganisedFeatures, ExcludeBordersOfHoles) {
  const auto holes = cloud_with_depth(
      [](int x, int y, const Eigen::Vector3d&) { return (x / 20 + y / 20) % 2 == 0 ? 2.0 : 0.0; });
  const FeatureCloud features = extract(holes);
  EXPECT_TRUE(features.edges.empty());
  for (const PlaneFeature& plane : features.planes) EXPECT_NEAR(plane.point.z(), 2.0F, 1e-4F);
}

TEST(OrganisedFeatures, ExcludeGrazingPlanes) {
  // A wall rotated by 55 degrees: nearly frontal at the right, grazing at the left.
  const double angle = 55.0 * M_PI / 180.0;
  const Eigen::Vector3d normal(-std::sin(angle), 0.0, -std::cos(angle));
  const LabeledCloud wall = cloud_with_depth(
      [&](int, int, const Eigen::Vector3d& ray) { return -1.5 / normal.dot(ray); });
  const auto least_incidence = [&](double min_incidence) {
    FeatureConfig config;
    config.min_incidence = min_incidence;
    const FeatureCloud features = FeatureExtractor(config).extract(wall);
    EXPECT_GT(features.planes.size(), 50U);
    double least = 1.0;
    for (const PlaneFeature& plane : features.planes) {
      EXPECT_GT(plane.normal.cast<double>().dot(normal), 0.9999);
      least = std::min(least, -normal.dot(plane.point.cast<double>().normalized()));
    }
    return least;
  };
  EXPECT_GT(least_incidence(0.7), 0.699);
  EXPECT_LT(least_incidence(0.0), 0.65);
}

TEST(OrganisedFeatures, ExcludeDynamicPointsAndBorders) {
  LabeledCloud cloud = testing::organised_cloud(BoxRoom{}, kTowardCorner);
  const CameraModel camera(cloud.camera);
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 40; x < 90; ++x) {
      const auto i = static_cast<std::size_t>(y * cloud.width + x);
      cloud.labels[i] = PointLabel::kDynamic;
      cloud.points[i] *= 0.5F;
    }
  }
  const FeatureCloud features = extract(cloud);
  ASSERT_GT(features.planes.size(), 100U);
  const auto column = [&](const Eigen::Vector3f& p) {
    return camera.project(p.cast<double>()).x();
  };
  for (const PlaneFeature& plane : features.planes) {
    EXPECT_TRUE(column(plane.point) < 39.6 || column(plane.point) > 89.4);
  }
  for (const EdgeFeature& edge : features.edges) {
    EXPECT_TRUE(column(edge.point) < 39.6 || column(edge.point) > 89.4);
  }
}

TEST(OrganisedFeatures, AreEmptyWithoutReturns) {
  for (const LabeledCloud& cloud :
       {LabeledCloud{}, cloud_with_depth([](int, int, const Eigen::Vector3d&) { return 0.0; })}) {
    const FeatureCloud features = extract(cloud);
    EXPECT_TRUE(features.planes.empty());
    EXPECT_TRUE(features.edges.empty());
  }
}

TEST(FeatureExtractor, KeepsStampAndOffset) {
  LabeledCloud cloud = testing::organised_cloud(BoxRoom{}, kOrigin);
  cloud.stamp = Timestamp(123);
  cloud.points_offset = Duration(-7);
  const FeatureCloud features = extract(cloud);
  EXPECT_EQ(features.stamp, Timestamp(123));
  EXPECT_EQ(features.points_offset, Duration(-7));
  EXPECT_EQ(features.intensity.size(), static_cast<std::size_t>(FeatureConfig{}.pyramid_levels));
  cloud.colors.clear();
  EXPECT_TRUE(extract(cloud).intensity.empty());
}

}  // namespace
}  // namespace mms
