#include "mms/io/cloud/point_cloud_file.hpp"

#include <algorithm>

namespace mms {
namespace {

template <class T>
void keep_valid(std::vector<T>& values, const std::vector<bool>& valid) {
  if (values.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    if (valid[i]) values[kept++] = values[i];
  }
  values.resize(kept);
}

}  // namespace

std::size_t remove_invalid_points(PointCloudFile& cloud) {
  for (Eigen::Vector3f& normal : cloud.normals) {
    if (!normal.allFinite()) normal.setZero();
  }
  std::vector<bool> valid;
  valid.reserve(cloud.points.size());
  for (const Eigen::Vector3f& point : cloud.points) valid.push_back(point.allFinite());
  const auto invalid = static_cast<std::size_t>(std::count(valid.begin(), valid.end(), false));
  if (invalid == 0) return 0;
  keep_valid(cloud.points, valid);
  keep_valid(cloud.normals, valid);
  keep_valid(cloud.colors, valid);
  keep_valid(cloud.labels, valid);
  keep_valid(cloud.observations, valid);
  keep_valid(cloud.intensities, valid);
  keep_valid(cloud.time_offsets, valid);
  return invalid;
}

}  // namespace mms
