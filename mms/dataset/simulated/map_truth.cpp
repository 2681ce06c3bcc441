#include "mms/dataset/simulated/map_truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mms {

MapTruth::MapTruth(double voxel_size, int stride)
    : voxel_size_(voxel_size), stride_(std::max(1, stride)) {}

void MapTruth::add(const SimulatedFrame& simulated,
                   const Transform<World, Sensor>& T_world_sensor) {
  for (std::size_t i = 0; i < simulated.scan.points.size(); ++i) {
    add(simulated.scan.points[i], simulated.scan.labels[i]);
  }
  const Frame& frame = simulated.frame;
  const ExactView& exact = simulated.exact;
  if (!frame.has_depth() || !frame.depth.same_size(exact.depth)) return;
  const std::vector<Eigen::Vector3f>& rays = rays_of(*frame.calibration->camera);
  const Eigen::Isometry3f pose = T_world_sensor.isometry().cast<float>();
  for (int y = 0; y < frame.depth.height(); y += stride_) {
    for (int x = 0; x < frame.depth.width(); x += stride_) {
      const float measured = frame.depth(x, y);
      const float depth = exact.depth(x, y);
      if (!(measured > 0.0F) || !std::isfinite(measured) || !std::isfinite(depth)) continue;
      const auto pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.depth.width()) +
          static_cast<std::size_t>(x);
      add(pose * (rays[pixel] * depth), exact.object(x, y));
    }
  }
}

void MapTruth::add(const Eigen::Vector3f& point, std::int32_t label) {
  Points& points = points_.try_emplace(label, voxel_size_, std::numeric_limits<std::size_t>::max())
                       .first->second;
  const VoxelKey key = points.key(point);
  if (points.find(key) == nullptr) points.touch(key) = point;
}

TruthCloud MapTruth::cloud() const {
  TruthCloud cloud;
  for (const auto& [label, points] : points_) {
    for (const Points::Entry& entry : points.entries()) {
      cloud.points.push_back(entry.cell);
      cloud.labels.push_back(label);
    }
  }
  return cloud;
}

const std::vector<Eigen::Vector3f>& MapTruth::rays_of(const CameraIntrinsics& camera) {
  if (rays_.empty() || !(camera == camera_)) {
    camera_ = camera;
    rays_ = CameraModel(camera).ray_table();
  }
  return rays_;
}

}  // namespace mms
