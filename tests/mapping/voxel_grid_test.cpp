#include "mms/mapping/static_map/surface_voxels.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

/// A voxel of one hit at every integer point of a cube around the origin.
VoxelGrid cube(int half) {
  VoxelGrid grid(1.0);
  for (int z = -half; z < half; ++z) {
    for (int y = -half; y < half; ++y) {
      for (int x = -half; x < half; ++x) {
        Voxel& voxel = grid.place(VoxelKey{x, y, z}).voxel();
        voxel.position = Eigen::Array3f(Eigen::Array3i(x, y, z).cast<float>()) + 0.5F;
        voxel.weight = 1.0F;
        voxel.hits = 1;
      }
    }
  }
  return grid;
}

TEST(VoxelGrid, FindsVoxelsOnBothSidesOfOrigin) {
  const VoxelGrid grid = cube(10);
  EXPECT_EQ(grid.size(), 8000U);
  for (const VoxelBlock& block : grid.blocks()) {
    for (const Voxel& voxel : block.voxels) {
      const VoxelKey key = block.voxel_key(voxel);
      EXPECT_EQ(grid.find(key), &voxel);
      EXPECT_EQ(voxel_key(voxel.position, 1.0F), key);
    }
  }
  EXPECT_EQ(grid.find({10, 0, 0}), nullptr);
  EXPECT_EQ(grid.find({100, 0, 0}), nullptr);
}

TEST(VoxelGrid, FindsRemainingVoxelsAfterErasing) {
  VoxelGrid grid = cube(8);
  const auto is_right = [](const Voxel& voxel) { return std::floor(voxel.position.x()) > 2.0F; };
  std::size_t erased = 0;
  for (VoxelBlock& block : grid.blocks()) erased += grid.erase_if(block, is_right);
  EXPECT_EQ(erased, 5U * 256U);
  EXPECT_EQ(grid.size(), 4096U - erased);
  EXPECT_EQ(grid.find({3, 0, 0}), nullptr);
  ASSERT_NE(grid.find({2, 0, 0}), nullptr);
  EXPECT_EQ(grid.find({2, 0, 0})->position.x(), 2.5F);
  grid.place(VoxelKey{3, 0, 0});
  EXPECT_NE(grid.find({3, 0, 0}), nullptr);
}

TEST(VoxelGrid, CoarseVoxelsAreMeansOfFineVoxels) {
  const VoxelGrid coarse = cube(8).coarsened(true);
  EXPECT_EQ(coarse.voxel_size(), 2.0);
  EXPECT_EQ(coarse.size(), 512U);
  const Voxel* voxel = coarse.find({-1, 0, 3});
  ASSERT_NE(voxel, nullptr);
  EXPECT_TRUE(voxel->position.isApprox(Eigen::Vector3f(-1.0F, 1.0F, 7.0F)));
  EXPECT_EQ(voxel->weight, 8.0F);
  EXPECT_EQ(voxel->hits, 1);
}

TEST(VoxelGrid, CoarseBlocksKeepTheirViews) {
  VoxelGrid fine(1.0);
  const VoxelGrid::Place place = fine.place(VoxelKey{0, 0, 0});
  place.voxel().hits = 1;
  place.voxel().weight = 1.0F;
  place.block->views = 200;
  EXPECT_EQ(fine.coarsened(true).blocks().front().views, 200);
  EXPECT_EQ(fine.coarsened(false).blocks().front().views, 0);
}

TEST(VoxelGrid, MemoryGrowsWithVoxels) {
  EXPECT_GT(cube(16).memory_bytes(), 4 * cube(8).memory_bytes());
  EXPECT_GE(cube(16).memory_bytes(), cube(16).size() * sizeof(Voxel));
}

}  // namespace
}  // namespace mms
