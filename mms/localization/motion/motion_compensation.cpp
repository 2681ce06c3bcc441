#include "mms/localization/motion/motion_compensation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mms {
namespace {

/// [-]: largest compensated time offset over the interval between frames.
/// Source: the velocity comes from poses compensated with the one before, whose error would grow
/// from frame to frame from one half on; a tenth below that.
constexpr double kMaxOffset = 0.45;

/// [s]: points within one slice share their pose.
/// Source: at 10 m/s the sensor moves 1 cm in that time, half a LiDAR's noise.
constexpr double kSlice = 0.001;

void move(const Eigen::Isometry3f& T, FeatureCloud& features) {
  for (EdgeFeature& edge : features.edges) edge.point = T * edge.point;
  for (PlaneFeature& plane : features.planes) {
    plane.point = T * plane.point;
    plane.normal = T.linear() * plane.normal;
  }
}

/// Pose of the sensor at times about a stamp, relative to its pose at the stamp.
class Motion {
 public:
  explicit Motion(const Vector6d& velocity) : velocity_(velocity) {}

  const Eigen::Isometry3f& at(double seconds) {
    const auto slice = static_cast<long>(std::lround(seconds / kSlice));
    if (slice != slice_)
      T_ = se3::exp(velocity_ * (static_cast<double>(slice) * kSlice)).cast<float>();
    slice_ = slice;
    return T_;
  }

 private:
  Vector6d velocity_;
  long slice_ = 0;
  Eigen::Isometry3f T_ = Eigen::Isometry3f::Identity();
};

}  // namespace

FeatureCloud at_stamp(FeatureCloud features, const Vector6d& velocity, double elapsed) {
  if (features.points_offset == Duration::zero() || elapsed <= 0.0) return features;
  const double limit = kMaxOffset * elapsed;
  const double offset = std::clamp(to_seconds(features.points_offset), -limit, limit);
  move(se3::exp(velocity * offset).cast<float>(), features);
  return features;
}

void deskew(FeatureCloud& features, const Vector6d& velocity) {
  Motion motion(velocity);
  for (EdgeFeature& edge : features.edges) {
    edge.point = motion.at(static_cast<double>(edge.time_offset)) * edge.point;
  }
  for (PlaneFeature& plane : features.planes) {
    const Eigen::Isometry3f& T = motion.at(static_cast<double>(plane.time_offset));
    plane.point = T * plane.point;
    plane.normal = T.linear() * plane.normal;
  }
}

void deskew(LabeledCloud& cloud, const Vector6d& velocity) {
  Motion motion(velocity);
  for (std::size_t i = 0; i < cloud.time_offset.size(); ++i) {
    cloud.points[i] = motion.at(static_cast<double>(cloud.time_offset[i])) * cloud.points[i];
  }
}

}  // namespace mms
