#include "mms/global_map/keyframes/scan_keypoints.hpp"

#include <algorithm>
#include <cstddef>
#include <opencv2/features2d.hpp>

#include "mms/global_map/keyframes/density_image.hpp"
#include "mms/global_map/keyframes/opencv_descriptor.hpp"
#include "mms/mapping/ground/floor.hpp"

namespace mms {
namespace {

/// [-]: keypoints of a density image, at most. Source: as MapClosures and the images of cameras.
constexpr int kMaxScanKeypoints = 500;

/// [-]: difference of brightness of a corner. Source: initial choice, half a voxel of a column more
/// or less than around it.
constexpr int kCornerThreshold = 10;

/// [px]: boundary without keypoints, and side of the patch of a descriptor. Source: ORB's own.
constexpr int kPatch = 31;

/// [-]: largest distance of the descriptors of two places of one image that look alike. Source:
/// MapClosures, 35 of 256 bits.
constexpr int kSelfSimilar = 35;

}  // namespace

Eigen::Isometry3d floor_frame(const std::vector<Eigen::Vector3f>& points,
                              const Eigen::Vector3d& up) {
  MapCloud cloud;
  cloud.points = points;
  cloud.normals.assign(points.size(), Eigen::Vector3f::Zero());
  return map_frame(find_floor(cloud, up, FloorConfig{}), Eigen::Vector3d::UnitX()).isometry();
}

ImageKeypoints extract_scan_keypoints(std::vector<Eigen::Vector3f> points,
                                      const Eigen::Isometry3d& T_sensor_floor) {
  ImageKeypoints result;
  const Eigen::Isometry3f T_floor_sensor = T_sensor_floor.inverse().cast<float>();
  for (Eigen::Vector3f& point : points) point = T_floor_sensor * point;
  DensityImage image = make_density_image(points);
  if (image.share.empty()) return result;
  const cv::Mat density(image.share.height(), image.share.width(), CV_8U,
                        image.share.pixels().data());
  // The scale is known: one level is enough.
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(kMaxScanKeypoints, 1.2F, 1, kPatch, 0, 2,
                                               cv::ORB::HARRIS_SCORE, kPatch, kCornerThreshold);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat rows;
  orb->detectAndCompute(density, cv::noArray(), keypoints, rows);
  std::vector<BinaryDescriptor> descriptors;
  for (int row = 0; row < rows.rows; ++row) descriptors.push_back(descriptor_of(rows, row));
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const Eigen::Vector2d place =
        image.place_of({static_cast<double>(keypoints[i].pt.x), keypoints[i].pt.y});
    bool is_unique = true;
    for (std::size_t j = 0; j < descriptors.size() && is_unique; ++j) {
      is_unique = j == i || hamming_distance(descriptors[i], descriptors[j]) > kSelfSimilar;
    }
    if (!is_unique) continue;
    result.descriptors.push_back(descriptors[i]);
    result.points.emplace_back(
        (T_sensor_floor * Eigen::Vector3d(place.x(), place.y(), 0.0)).cast<float>());
    result.pixels.emplace_back(place.cast<float>());
  }
  return result;
}

}  // namespace mms
