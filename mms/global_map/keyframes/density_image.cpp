#include "mms/global_map/keyframes/density_image.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {
namespace {

/// [m]: least height of points. Source: the floor, with noise of 2 cm and a tilt of half a degree
/// at 10 m, fills no pixel.
constexpr float kMinHeight = 0.2F;

/// [m]: largest height of points. Source: initial choice; the roofs of halls repeat, and are seen
/// from afar alone.
constexpr float kMaxHeight = 5.0F;

/// [-]: occupied voxels of a column of the largest value. Source: initial choice; 1.5 m of a wall,
/// which 16 rings cover from 3 m on.
constexpr int kFullColumn = 15;

/// [px]: empty boundary of the image. Source: ORB finds no keypoints within 31 px of it.
constexpr int kBorder = 32;

/// [px]: largest side of the image. Source: bounds the memory; points are at most 40 m away.
constexpr int kMaxSide = 1024;

}  // namespace

DensityImage make_density_image(std::span<const Eigen::Vector3f> points) {
  constexpr auto kInverse = static_cast<float>(1.0 / kDensityPixel);
  std::vector<VoxelKey> voxels;
  for (const Eigen::Vector3f& point : points) {
    if (point.z() > kMinHeight && point.z() < kMaxHeight && point.allFinite()) {
      voxels.push_back(voxel_key(point, kInverse));
    }
  }
  DensityImage image;
  if (voxels.empty()) return image;
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  constexpr int kMax = std::numeric_limits<int>::max();
  Eigen::Vector2i low(kMax, kMax);
  Eigen::Vector2i high(-kMax, -kMax);
  for (const VoxelKey& voxel : voxels) {
    low = low.cwiseMin(Eigen::Vector2i(voxel.x, voxel.y));
    high = high.cwiseMax(Eigen::Vector2i(voxel.x, voxel.y));
  }
  low.array() -= kBorder;
  const Eigen::Vector2i size = (high - low).array().min(kMaxSide - kBorder) + 1 + kBorder;
  image.share = Image<std::uint8_t>(size.x(), size.y());
  image.corner = kDensityPixel * low.cast<double>();
  for (const VoxelKey& voxel : voxels) {
    const int x = voxel.x - low.x();
    const int y = voxel.y - low.y();
    if (!image.share.contains(x, y)) continue;
    std::uint8_t& share = image.share(x, y);
    share = static_cast<std::uint8_t>(std::min(share + 255 / kFullColumn, 255));
  }
  return image;
}

}  // namespace mms
