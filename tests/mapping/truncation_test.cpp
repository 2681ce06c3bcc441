#include "mms/mapping/tracking/truncation.hpp"

#include <gtest/gtest.h>

#include "tests/mapping/synthetic_cloud.hpp"

namespace mms {
namespace {

/// A wall at 5 m, and a board at 3 m in those pixels, which is the only cluster.
LabeledCloud board(int x_begin, int x_end, int y_begin, int y_end) {
  const auto is_board = [=](int x, int y) {
    return x >= x_begin && x < x_end && y >= y_begin && y < y_end;
  };
  LabeledCloud cloud = test::organised_cloud(
      [&](int x, int y, const Eigen::Vector3f&) { return is_board(x, y) ? 3.0F : 5.0F; });
  cloud.clusters.resize(1);
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      if (is_board(x, y)) cloud.cluster[static_cast<std::size_t>(y * cloud.width + x)] = 0;
    }
  }
  return cloud;
}

std::vector<ObjectMeasurement::Truncation> truncations_of(const LabeledCloud& cloud) {
  return find_truncations(cloud, {cloud.cluster, {0}});
}

/// Sets the depth of pixels [m]; no return for NaN.
void cover(LabeledCloud& cloud, int x_begin, int x_end, int y_begin, int y_end, float z) {
  for (int y = y_begin; y < y_end; ++y) {
    for (int x = x_begin; x < x_end; ++x) {
      const auto i = static_cast<std::size_t>(y * cloud.width + x);
      cloud.points[i] = std::isfinite(z)
                            ? Eigen::Vector3f(cloud.points[i] * (z / cloud.points[i].z()))
                            : Eigen::Vector3f::Constant(NAN);
      cloud.cluster[i] = -1;
    }
  }
}

TEST(ClusterTruncations, NoneWhenVisibleOnAllSides) {
  EXPECT_FALSE(truncations_of(board(40, 90, 30, 100)).at(0).any());
}

TEST(ClusterTruncations, ImageBorderTruncates) {
  const auto corner = truncations_of(board(0, 50, 60, 120)).at(0);
  EXPECT_TRUE(corner.left);
  EXPECT_TRUE(corner.bottom);
  EXPECT_FALSE(corner.right);
  EXPECT_FALSE(corner.top);
}

TEST(ClusterTruncations, NearerSurfaceTruncatesAcrossNoReturns) {
  LabeledCloud cloud = board(40, 90, 30, 100);
  cover(cloud, 80, 110, 20, 110, 2.0F);
  cover(cloud, 78, 80, 20, 110, NAN);
  const auto truncation = truncations_of(cloud).at(0);
  EXPECT_TRUE(truncation.right);
  EXPECT_FALSE(truncation.left);
  EXPECT_FALSE(truncation.top);
}

TEST(ClusterTruncations, SmallOccluderDoesNotTruncate) {
  LabeledCloud cloud = board(40, 90, 30, 100);
  cover(cloud, 86, 100, 30, 40, 2.0F);
  EXPECT_FALSE(truncations_of(cloud).at(0).right);
}

}  // namespace
}  // namespace mms
