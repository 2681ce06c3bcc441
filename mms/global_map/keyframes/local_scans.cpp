#include "mms/global_map/keyframes/local_scans.hpp"

#include <cstddef>
#include <utility>

#include "mms/geometry/voxels/voxel_downsampling.hpp"

namespace mms {
namespace {

/// [m]: path of the scans that are put together. Source: the rings of 16 are then closer than
/// `kPointGrid` on what is beside the path; the odometry drifts by 1 cm.
constexpr double kLocalPath = 10.0;

/// [m]: distance from the sensor up to which points are used. Source: an error of the heading of
/// 0.1 degrees displaces them by less than a pixel of the density image.
constexpr float kLocalRange = 40.0F;

/// [m]: side of the voxels that keep one point of a scan. Source: half a pixel of the density
/// image.
constexpr float kPointGrid = 0.05F;

/// [-]: such scans, at most. Source: twice those of `kLocalPath` every 0.5 m; a sensor that turns
/// on the spot has keyframes, but no path.
constexpr std::size_t kMaxScans = 40;

}  // namespace

void LocalScans::add(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] != PointLabel::kStatic || !(cloud.points[i].norm() < kLocalRange)) continue;
    points.push_back(cloud.points[i]);
  }
  Scan scan{T_world_sensor.isometry(), 0.0, voxel_downsample(points, kPointGrid).points};
  if (!scans_.empty()) {
    const Eigen::Vector3d way =
        scan.T_world_sensor.translation() - scans_.back().T_world_sensor.translation();
    scan.path = scans_.back().path + way.norm();
  }
  scans_.push_back(std::move(scan));
  while (scans_.size() > kMaxScans || scans_.back().path - scans_.front().path > kLocalPath) {
    scans_.pop_front();
  }
}

std::vector<Eigen::Vector3f> LocalScans::points() const {
  std::vector<Eigen::Vector3f> points;
  for (const Scan& scan : scans_) {
    const Eigen::Isometry3f T =
        (scans_.back().T_world_sensor.inverse() * scan.T_world_sensor).cast<float>();
    for (const Eigen::Vector3f& point : scan.points) points.push_back(T * point);
  }
  return points;
}

}  // namespace mms
