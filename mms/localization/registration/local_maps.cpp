#include "mms/localization/registration/local_maps.hpp"

namespace mms {
namespace {

/// [-]: points kept in one voxel. Source: an edge along its side has five at kMinSpacing; the rest
/// allows for diagonals and corners.
constexpr int kMaxPointsPerVoxel = 8;

/// [voxels]: least distance between points.
/// Source: initial choice; five points a voxel's side show the direction of an edge.
constexpr float kMinSpacing = 0.2F;

PointMap::Limits limits(double voxel_size, std::size_t max_voxels) {
  return {.max_points_per_voxel = kMaxPointsPerVoxel,
          .min_spacing = kMinSpacing * static_cast<float>(voxel_size),
          .max_voxels = max_voxels};
}

template <class Feature>
std::vector<Eigen::Vector3f> moved(const std::vector<Feature>& features,
                                   const Eigen::Isometry3f& T) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(features.size());
  for (const Feature& feature : features) points.push_back(T * feature.point);
  return points;
}

}  // namespace

LocalMaps::LocalMaps(double voxel_size, std::size_t max_voxels)
    : edges(voxel_size, limits(voxel_size, max_voxels)),
      plane_points(voxel_size, limits(voxel_size, max_voxels)),
      surfaces(voxel_size, max_voxels) {}

void LocalMaps::insert(const FeatureCloud& features, const Eigen::Isometry3d& T_world_sensor,
                       Association association) {
  const Eigen::Isometry3f T = T_world_sensor.cast<float>();
  edges.insert(moved(features.edges, T));
  if (association == Association::kPaper) {
    plane_points.insert(moved(features.planes, T));
  } else {
    surfaces.insert(features.planes, T_world_sensor);
  }
}

LocalMaps LocalMaps::resized(double voxel_size, std::size_t max_voxels) const {
  LocalMaps maps(voxel_size, max_voxels);
  maps.edges.insert(edges.points());
  maps.plane_points.insert(plane_points.points());
  maps.surfaces.insert(surfaces);
  return maps;
}

void LocalMaps::remove_farther_than(const Eigen::Vector3f& centre, float distance) {
  edges.remove_farther_than(centre, distance);
  plane_points.remove_farther_than(centre, distance);
  surfaces.remove_farther_than(centre, distance);
}

}  // namespace mms
