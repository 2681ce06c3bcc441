#include "mms/io/results/octomap_io.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <set>

#include "mms/core/error.hpp"
#include "mms/core/random_stream.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

/// State that liboctomap reads at the center of a voxel.
Occupancy found(const octomap::OcTree& tree, const VoxelKey& key) {
  const double size = tree.getResolution();
  const auto* node = tree.search((key.x + 0.5) * size, (key.y + 0.5) * size, (key.z + 0.5) * size);
  if (node == nullptr) return Occupancy::kUnknown;
  return tree.isNodeOccupied(node) ? Occupancy::kOccupied : Occupancy::kFree;
}

TEST(OctomapIo, LiboctomapReadsSameVoxels) {
  RandomStream random(5);
  const auto coordinate = [&] { return static_cast<int>(random.below(40)) - 20; };
  std::set<VoxelKey> occupied;
  std::set<VoxelKey> free;
  for (int i = 0; i < 5000; ++i) occupied.insert({coordinate(), coordinate(), coordinate()});
  for (int i = 0; i < 20000; ++i) {
    const VoxelKey key{coordinate(), coordinate(), coordinate()};
    if (!occupied.contains(key)) free.insert(key);
  }
  const TempFolder folder;
  const auto path = folder.path() / "map.bt";
  EXPECT_EQ(
      write_octomap(path, {0.05, {occupied.begin(), occupied.end()}, {free.begin(), free.end()}}),
      0U);
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(path.string()));
  EXPECT_DOUBLE_EQ(tree.getResolution(), 0.05);
  for (int x = -21; x <= 21; ++x) {
    for (int y = -21; y <= 21; ++y) {
      for (int z = -21; z <= 21; ++z) {
        const VoxelKey key{x, y, z};
        const Occupancy expected = occupied.contains(key) ? Occupancy::kOccupied
                                   : free.contains(key)   ? Occupancy::kFree
                                                          : Occupancy::kUnknown;
        ASSERT_EQ(found(tree, key), expected) << x << ' ' << y << ' ' << z;
      }
    }
  }
}

TEST(OctomapIo, SameVoxelsGiveSameBytes) {
  const TempFolder folder;
  const OccupancyVoxels voxels{0.1, {{0, 0, 0}, {5, 6, 7}}, {{1, 0, 0}, {-9, 3, 2}}};
  write_octomap(folder.path() / "a.bt", voxels);
  write_octomap(folder.path() / "b.bt", voxels);
  EXPECT_EQ(read_file(folder.path() / "a.bt"), read_file(folder.path() / "b.bt"));
}

TEST(OctomapIo, EmptyMapIsReadable) {
  const TempFolder folder;
  const auto path = folder.path() / "map.bt";
  write_octomap(path, {0.1, {}, {}});
  octomap::OcTree tree(1.0);
  EXPECT_TRUE(tree.readBinary(path.string()));
  EXPECT_EQ(tree.size(), 0U);
}

TEST(OctomapIo, CountsVoxelsBeyondOctomapRange) {
  const TempFolder folder;
  const auto path = folder.path() / "map.bt";
  EXPECT_EQ(write_octomap(path, {0.1, {{32768, 0, 0}, {32767, 0, 0}}, {{0, -32769, 0}}}), 2U);
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(path.string()));
  EXPECT_EQ(found(tree, {32767, 0, 0}), Occupancy::kOccupied);
}

TEST(OctomapIo, ErrorNamesMissingFolder) {
  const TempFolder folder;
  expect_in("map.bt: cannot be written", message_of<FileError>([&] {
              write_octomap(folder.path() / "none/map.bt", {0.1, {}, {}});
            }));
}

}  // namespace
}  // namespace mms
