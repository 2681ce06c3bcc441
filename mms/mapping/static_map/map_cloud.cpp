#include "mms/mapping/static_map/map_cloud.hpp"

#include <tsl/robin_map.h>

#include "mms/geometry/voxels/voxel_key.hpp"
#include "mms/mapping/static_map/surface_voxels.hpp"

namespace mms {
namespace {

/// Sums over the points of a voxel, weighted by their observations.
struct PointSum {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  Eigen::Vector3f color = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  int observations = 0;
};

}  // namespace

void append(MapCloud& map, const MapCloud& other) {
  map.points.insert(map.points.end(), other.points.begin(), other.points.end());
  map.colors.insert(map.colors.end(), other.colors.begin(), other.colors.end());
  map.normals.insert(map.normals.end(), other.normals.begin(), other.normals.end());
  map.observations.insert(map.observations.end(), other.observations.begin(),
                          other.observations.end());
}

MapCloud merged(const MapCloud& map, double voxel_size) {
  const auto inverse_size = static_cast<float>(1.0 / voxel_size);
  tsl::robin_map<VoxelKey, std::size_t, VoxelKeyHash> index;
  std::vector<PointSum> sums;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const auto [place, is_new] =
        index.try_emplace(voxel_key(map.points[i], inverse_size), sums.size());
    if (is_new) sums.emplace_back();
    PointSum& sum = sums[place->second];
    const auto weight = static_cast<float>(map.observations[i]);
    const Rgb& color = map.colors[i];
    sum.point += weight * map.points[i];
    sum.color += weight * Eigen::Vector3f(color.r, color.g, color.b);
    sum.normal += weight * map.normals[i];
    sum.observations += map.observations[i];
  }
  MapCloud result;
  for (const PointSum& sum : sums) {
    const auto weight = static_cast<float>(sum.observations);
    const float length = sum.normal.norm();
    result.points.push_back(sum.point / weight);
    result.colors.push_back(to_rgb(sum.color / weight));
    result.normals.push_back(length > 0.0F ? Eigen::Vector3f(sum.normal / length)
                                           : Eigen::Vector3f::Zero());
    result.observations.push_back(sum.observations);
  }
  return result;
}

MapCloud moved(MapCloud map, const std::vector<Timestamp>& stamps,
               const StampCorrection& correction) {
  tsl::robin_map<std::int64_t, Eigen::Isometry3f> corrections;  // by stamp [ns]
  for (std::size_t i = 0; i < map.size(); ++i) {
    const auto [known, is_new] = corrections.try_emplace(stamps[i].nanoseconds());
    if (is_new) known.value() = correction(stamps[i]).cast<float>();
    const Eigen::Isometry3f& T = known.value();
    map.points[i] = T * map.points[i];
    map.normals[i] = T.linear() * map.normals[i];
  }
  return map;
}

}  // namespace mms
