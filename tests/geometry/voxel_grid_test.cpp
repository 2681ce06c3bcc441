#include "mms/geometry/voxels/voxel_downsampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <tuple>

namespace mms {
namespace {

TEST(VoxelGrid, MeansEqualReference) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 3000; ++i) {
    points.emplace_back(uniform(random), uniform(random), uniform(random));
  }
  constexpr float kSize = 0.21F;
  std::map<std::tuple<int, int, int>, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto cell = [&](int axis) {
      return static_cast<int>(std::floor(points[i][axis] / kSize));
    };
    cells[{cell(0), cell(1), cell(2)}].push_back(i);
  }
  const VoxelDownsampled thin = voxel_downsample(points, kSize);
  ASSERT_EQ(thin.points.size(), cells.size());
  for (const auto& [key, members] : cells) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::size_t i : members) mean += points[i].cast<double>();
    mean /= static_cast<double>(members.size());
    const auto voxel = static_cast<std::size_t>(thin.voxel[members.front()]);
    EXPECT_LT((thin.points[voxel].cast<double>() - mean).norm(), 1e-6);
    for (const std::size_t i : members) EXPECT_EQ(thin.voxel[i], thin.voxel[members.front()]);
  }
}

TEST(VoxelGrid, KeepsOrderOfFirstPointsAndSkipsInvalid) {
  const std::vector<Eigen::Vector3f> points = {
      {5.0F, 0.0F, 0.0F}, {std::nanf(""), 0.0F, 0.0F}, {-5.0F, 0.0F, 0.0F}, {5.2F, 0.0F, 0.0F}};
  const VoxelDownsampled thin = voxel_downsample(points, 1.0F);
  ASSERT_EQ(thin.points.size(), 2U);
  EXPECT_NEAR(thin.points[0].x(), 5.1F, 1e-6F);
  EXPECT_EQ(thin.voxel, (std::vector<int>{0, VoxelDownsampled::kNone, 1, 0}));
}

}  // namespace
}  // namespace mms
