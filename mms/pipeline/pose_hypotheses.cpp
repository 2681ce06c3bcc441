#include "mms/pipeline/pose_hypotheses.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/fusion/clusters/dynamic_parts.hpp"

namespace mms {
namespace {

/// [-]: share of the valid points that overruled masks must cover to change the pose.
/// Source: computing time, which is 8 ms/frame less than with 0.03 on `desk_crowd`; a pose
/// without a tenth of the points is as good (1.00 cm, 1.03 with 0.03).
constexpr double kMinOverruledShare = 0.1;

/// [-]: share of the valid points under masks from which on the rest may be too little for a pose,
/// or for a map to begin with. Source: initial choice; people cover 52 % of the recording
/// `desk_crowd` at most.
constexpr double kMuchMasked = 0.5;

/// [-]: share of the masked points in known space that are on static surfaces from which on masks
/// that cover much may be wrong. Source: at most 0.56 under the right masks of `desk_crowd`, at
/// least 0.68 under the false ones of `fr1_xyz_clip`.
constexpr double kMinMaskedAgreement = 0.6;

/// [-]: factor by which ignoring the masks must increase the points on known surfaces.
/// Source: as `kMinInlierGain` of the odometry.
constexpr double kMinSupportGain = 1.05;

/// [-]: share of the valid points on known surfaces from which on a pose that ignores the masks is
/// believed. Source: initial choice; people before the lens are on none.
constexpr double kMinSupported = 0.5;

Transform<World, Sensor> pose_of(const Odometry::Alignment& alignment) {
  return Transform<World, Sensor>(alignment.registration->T_world_sensor);
}

/// All dynamic points.
Image<std::uint8_t> dynamic_points(const LabeledCloud& cloud) {
  Image<std::uint8_t> points(cloud.width, cloud.height);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = cloud.labels[i] == PointLabel::kDynamic ? 1 : 0;
  }
  return points;
}

/// Those of clusters that exceed the size of one object of their class.
Image<std::uint8_t> points_of_large_clusters(
    const LabeledCloud& cloud, const std::array<ObjectSize, kObjectClassCount>& sizes) {
  std::vector<bool> is_large;
  for (const DynamicCluster& cluster : cloud.clusters) {
    const auto object_class = static_cast<std::size_t>(cluster.object_class);
    const Eigen::AlignedBox3f box(cluster.box_min, cluster.box_max);
    is_large.push_back(object_class < sizes.size() && !fits(box, sizes[object_class]));
  }
  Image<std::uint8_t> points(cloud.width, cloud.height);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int cluster = cloud.cluster[i];
    const bool is_dynamic = cloud.labels[i] == PointLabel::kDynamic;
    points[i] = is_dynamic && cluster >= 0 && is_large[static_cast<std::size_t>(cluster)] ? 1 : 0;
  }
  return points;
}

/// Features of the static and the overruled points.
FeatureCloud extract_for_pose(const FeatureExtractor& extractor, LabeledCloud& cloud) {
  std::vector<PointLabel> labels = labels_for_pose(cloud);
  Image<std::uint8_t> dynamic_pixels = cloud.dynamic_pixels;
  for (std::size_t i = 0; i < cloud.overruled.size(); ++i) {
    if (cloud.overruled[i] != 0) dynamic_pixels[i] = 0;
  }
  std::swap(labels, cloud.labels);
  std::swap(dynamic_pixels, cloud.dynamic_pixels);
  FeatureCloud features = extractor.extract(cloud);
  std::swap(labels, cloud.labels);
  std::swap(dynamic_pixels, cloud.dynamic_pixels);
  return features;
}

}  // namespace

PoseHypotheses::PoseHypotheses(const MaskCheckConfig& mask_check, const FeatureConfig& features,
                               const Sizes& sizes)
    : mask_check_(mask_check, features.noise.depth), extractor_(features), sizes_(sizes) {}

/// The pose is estimated with the masks, and where recent views contradict them, without those that
/// are wrong. Where too little may be left beside the masks, a pose that ignores them is estimated,
/// too; the masks are judged from the pose under which more points are on known surfaces.
Odometry::Alignment PoseHypotheses::align(const Odometry& odometry, LabeledCloud& cloud,
                                          FeatureCloud features) const {
  Odometry::Alignment trusting = odometry.align(std::move(features));
  const double masked = dynamic_share(cloud);
  if (!mask_check_.enabled() || !cloud.organised() || masked == 0.0) return trusting;
  if (!trusting.registration) {
    return masked <= kMuchMasked ? trusting : align_first(odometry, cloud, masked);
  }
  if (!mask_check_.has_views()) return trusting;
  const bool is_poor = !trusting.is_valid || trusting.registration->degenerate_directions > 0;
  const bool may_be_poor = is_poor || masked > kMuchMasked;
  MaskEvidence evidence = mask_check_.compare(
      cloud, pose_of(trusting), may_be_poor ? MaskCheck::Points::kAll : MaskCheck::Points::kMasked);
  const bool in_doubt = is_poor || (may_be_poor && evidence.masked_agreement > kMinMaskedAgreement);
  std::optional<Odometry::Alignment> ignoring;
  if (in_doubt) {
    ignoring = align_overruled(odometry, cloud, dynamic_points(cloud));
    MaskEvidence other = mask_check_.compare(cloud, pose_of(*ignoring));
    ignoring->is_valid = ignoring->is_valid && other.supported_share > kMinSupported;
    if (other.supported_share > kMinSupportGain * evidence.supported_share) {
      evidence = std::move(other);
    }
  }
  if (evidence.overruled_share >= kMinOverruledShare) {
    Odometry::Alignment checked = align_overruled(odometry, cloud, std::move(evidence.overruled));
    if (checked.is_valid) return checked;
  }
  if (!trusting.is_valid && ignoring && ignoring->is_valid) {
    cloud.overruled = dynamic_points(cloud);
    return *std::move(ignoring);
  }
  cloud.overruled = {};
  return trusting;
}

/// A first frame under masks: those of clusters larger than an object are overruled, and if that is
/// not enough, all.
Odometry::Alignment PoseHypotheses::align_first(const Odometry& odometry, LabeledCloud& cloud,
                                                double masked) const {
  Image<std::uint8_t> large = points_of_large_clusters(cloud, sizes_);
  const bool is_enough = masked - overruled_share(cloud, large) <= kMuchMasked;
  return align_overruled(odometry, cloud, is_enough ? std::move(large) : dynamic_points(cloud));
}

Odometry::Alignment PoseHypotheses::align_overruled(const Odometry& odometry, LabeledCloud& cloud,
                                                    Image<std::uint8_t> overruled) const {
  cloud.overruled = std::move(overruled);
  return odometry.align(extract_for_pose(extractor_, cloud));
}

}  // namespace mms
