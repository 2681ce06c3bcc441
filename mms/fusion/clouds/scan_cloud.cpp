#include "mms/fusion/clouds/scan_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "mms/core/error.hpp"
#include "mms/geometry/camera.hpp"

namespace mms {
namespace {

/// Image position of LiDAR points.
class ScanProjection {
 public:
  ScanProjection(const CameraIntrinsics& camera, const Transform<Camera, Lidar>& T_camera_lidar)
      : camera_(camera), T_camera_lidar_(T_camera_lidar) {}

  /// Index of the pixel that sees `point` (LiDAR frame), none off the image or behind the camera.
  std::optional<std::size_t> pixel(const Eigen::Vector3f& point) const {
    const Eigen::Vector3d p = T_camera_lidar_ * point.cast<double>();
    if (!p.allFinite() || !camera_.in_lens_range(p)) return std::nullopt;
    const Eigen::Vector2d uv = camera_.project(p);
    const double x = std::round(uv.x());
    const double y = std::round(uv.y());
    const CameraIntrinsics& size = camera_.intrinsics();
    if (!(x >= 0.0 && y >= 0.0 && x < size.width && y < size.height)) return std::nullopt;
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
           static_cast<std::size_t>(x);
  }

 private:
  CameraModel camera_;
  Transform<Camera, Lidar> T_camera_lidar_;
};

void add_colors(const Frame& frame, LabeledCloud& cloud) {
  const CameraIntrinsics& camera = *frame.calibration->camera;
  if (camera.width != frame.color.width() || camera.height != frame.color.height()) {
    throw DataError("frame " + frame.name,
                    "the image is " + std::to_string(frame.color.width()) + " x " +
                        std::to_string(frame.color.height()) + " px, the calibrated one is " +
                        std::to_string(camera.width) + " x " + std::to_string(camera.height) +
                        " px",
                    "width and height in calibration.yaml must be the images'");
  }
  const ScanProjection projection(camera, frame.calibration->T_camera_lidar);
  cloud.colors.resize(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (const auto pixel = projection.pixel(cloud.points[i])) {
      cloud.colors[i] = frame.color[*pixel];
    }
  }
}

/// Intensity of points. Sensors give 0 to 255 or more, data sets also 0 to 1.
std::vector<std::uint8_t> scaled_intensity(const std::vector<float>& raw) {
  constexpr float kMaxIntensity = 255.0F;
  const bool shares = std::all_of(raw.begin(), raw.end(), [](float i) { return !(i > 1.0F); });
  std::vector<std::uint8_t> scaled;
  scaled.reserve(raw.size());
  for (const float value : raw) {
    const float intensity = shares ? kMaxIntensity * value : value;
    // 0 for NaN
    scaled.push_back(
        static_cast<std::uint8_t>(intensity > 0.0F ? std::min(intensity, kMaxIntensity) : 0.0F));
  }
  return scaled;
}

}  // namespace

LabeledCloud build_scan_cloud(const Frame& frame, const FusionConfig& config) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const auto min_range = static_cast<float>(config.min_range);
  const auto max_range = static_cast<float>(config.lidar_max_range);
  LabeledCloud cloud;
  cloud.stamp = frame.stamp;
  cloud.points = frame.scan.points;
  cloud.time_offset = frame.scan.time_offset;
  cloud.intensity = scaled_intensity(frame.scan.intensity);
  cloud.width = static_cast<int>(cloud.points.size());
  cloud.height = cloud.points.empty() ? 0 : 1;
  cloud.labels.assign(cloud.points.size(), PointLabel::kStatic);
  cloud.cluster.assign(cloud.points.size(), std::int16_t{-1});
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float range = cloud.points[i].norm();
    if (range >= min_range && range <= max_range) continue;
    cloud.points[i].setConstant(kNan);
    cloud.labels[i] = PointLabel::kInvalid;
  }
  if (!frame.color.empty() && frame.calibration->camera) add_colors(frame, cloud);
  return cloud;
}

PointMask project_masks(const std::vector<Eigen::Vector3f>& points, const MaskImage& mask,
                        const Calibration& calibration, int stride) {
  const ScanProjection projection(downscaled(*calibration.camera, stride),
                                  calibration.T_camera_lidar);
  PointMask result;
  result.raw.assign(points.size(), 0);
  result.dilated.assign(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (const auto pixel = projection.pixel(points[i])) {
      result.raw[i] = mask.raw[*pixel];
      result.dilated[i] = mask.dilated[*pixel];
    }
  }
  return result;
}

}  // namespace mms
