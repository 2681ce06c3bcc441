#include "mms/mapping/static_map/sparse_normals.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

/// Points without normals.
MapCloud without_normals(std::vector<Eigen::Vector3f> points) {
  MapCloud map;
  map.points = std::move(points);
  map.normals.assign(map.points.size(), Eigen::Vector3f::Zero());
  return map;
}

std::vector<SparsePoint> all_from(const MapCloud& map, const Eigen::Vector3f& viewpoint) {
  std::vector<SparsePoint> points;
  for (std::size_t i = 0; i < map.size(); ++i) points.push_back({i, viewpoint});
  return points;
}

/// Rings of points on the plane z = 0.5 x: dense along y, 0.4 m apart along x.
TEST(SparseNormals, FitsPlanesThroughSeveralRings) {
  std::vector<Eigen::Vector3f> points;
  for (int ring = 0; ring < 5; ++ring) {
    const float x = 0.4F * static_cast<float>(ring);
    for (int i = 0; i < 60; ++i) points.emplace_back(x, 0.1F * static_cast<float>(i), 0.5F * x);
  }
  MapCloud map = without_normals(points);
  fill_sparse_normals(map, all_from(map, {0.0F, 0.0F, 10.0F}));
  const Eigen::Vector3f expected = Eigen::Vector3f(-0.5F, 0.0F, 1.0F).normalized();
  for (const Eigen::Vector3f& normal : map.normals) EXPECT_GT(normal.dot(expected), 0.999F);
  fill_sparse_normals(map, all_from(map, {0.0F, 0.0F, -10.0F}));
  EXPECT_LT(map.normals[100].dot(expected), -0.999F);
}

TEST(SparseNormals, PointsToViewpointWithoutPlane) {
  // One ring, and a point alone.
  std::vector<Eigen::Vector3f> points = {{50.0F, 0.0F, 0.0F}};
  for (int i = 0; i < 20; ++i) points.emplace_back(0.0F, 0.1F * static_cast<float>(i), 0.0F);
  MapCloud map = without_normals(points);
  const Eigen::Vector3f viewpoint(0.0F, 0.0F, 4.0F);
  fill_sparse_normals(map, all_from(map, viewpoint));
  for (std::size_t i = 0; i < map.size(); ++i) {
    EXPECT_LT((map.normals[i] - (viewpoint - map.points[i]).normalized()).norm(), 1e-6F);
  }
}

TEST(SparseNormals, KeepsKnownNormals) {
  MapCloud map = without_normals({{0, 0, 0}, {1, 0, 0}});
  map.normals[0] = Eigen::Vector3f::UnitX();
  fill_sparse_normals(map, {{1, Eigen::Vector3f(1.0F, 2.0F, 0.0F)}});
  EXPECT_EQ(map.normals[0], Eigen::Vector3f(Eigen::Vector3f::UnitX()));
  EXPECT_EQ(map.normals[1], Eigen::Vector3f(Eigen::Vector3f::UnitY()));
}

}  // namespace
}  // namespace mms
