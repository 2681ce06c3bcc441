#include "mms/pipeline/pose_hypotheses.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/fusion/clusters/dynamic_parts.hpp"
#include "mms/fusion/masks/mask_weight.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/pipeline/pose_comparison.hpp"

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

/// [-]: share of the valid points under masks from which on the pose of the rest is doubted.
/// Source: with 0.5, people who covered 60 % moved the pose by 3 cm in a test; with 0.75, the false
/// masks of `desk_crowd` that lost 53 frames lose none.
constexpr double kNearlyAll = 0.75;

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

/// [m]: distance of the estimated from the predicted pose up to which views need not be compared
/// again. Source: half of `MaskCheckConfig::margin`.
constexpr double kNearby = 0.03;

/// [rad]: the same of the angle. Source: moves a point at 3 m by `kNearby`.
constexpr double kNearbyTurn = 0.01;

Transform<World, Sensor> pose_of(const Odometry::Alignment& alignment) {
  return Transform<World, Sensor>(alignment.registration->T_world_sensor);
}

bool is_poor(const Odometry::Alignment& alignment) {
  return !alignment.is_valid || alignment.registration->degenerate_directions > 0;
}

bool is_near(const Transform<World, Sensor>& a, const Transform<World, Sensor>& b) {
  const Eigen::Isometry3d difference = (a.inverse() * b).isometry();
  return difference.translation().norm() < kNearby && se3::angle(difference) < kNearbyTurn;
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

/// Those of the overruled points that belong to clusters of which most are; empty without any.
Image<std::uint8_t> points_of_overruled_clusters(const LabeledCloud& cloud,
                                                 Image<std::uint8_t> overruled) {
  std::vector<int> majority(cloud.clusters.size(), 0);
  for (std::size_t i = 0; i < overruled.size(); ++i) {
    if (cloud.labels[i] != PointLabel::kDynamic || cloud.cluster[i] < 0) continue;
    majority[static_cast<std::size_t>(cloud.cluster[i])] += overruled[i] != 0 ? 1 : -1;
  }
  const bool are_none =
      std::none_of(majority.begin(), majority.end(), [](int more) { return more > 0; });
  if (are_none) return {};
  for (std::size_t i = 0; i < overruled.size(); ++i) {
    const int cluster = cloud.cluster[i];
    if (cluster < 0 || majority[static_cast<std::size_t>(cluster)] <= 0) overruled[i] = 0;
  }
  return overruled;
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

/// Where hardly anything is left beside the masks, the pose of what is left can be wrong. Then all
/// points that no view contradicts are used, unless the points beside the masks contradict that
/// pose: people who walk together move it, a wall under a false mask does not.
Odometry::Alignment PoseHypotheses::align(const Odometry& odometry, LabeledCloud& cloud,
                                          FeatureCloud features) const {
  const double masked = dynamic_share(cloud);
  if (!mask_check_.enabled() || !cloud.organised() || masked == 0.0) {
    return odometry.align(std::move(features));
  }
  if (masked <= kNearlyAll || !mask_check_.has_views()) {
    return align_judged(odometry, cloud, std::move(features), masked);
  }
  const FeatureCloud beside = features;
  Odometry::Alignment judged = align_judged(odometry, cloud, std::move(features), masked);
  const bool is_enough = masked - overruled_share(cloud, cloud.overruled) <= kNearlyAll;
  if (!judged.registration || (is_enough && !is_poor(judged))) return judged;
  Image<std::uint8_t> overruled = std::move(cloud.overruled);
  const Transform<World, Sensor> pose = odometry.expected(cloud.stamp).value_or(pose_of(judged));
  Odometry::Alignment used =
      align_overruled(odometry, cloud, mask_check_.uncontradicted(cloud, pose));
  const auto fit = [&](const Odometry::Alignment& alignment) {
    return odometry.fit(beside, alignment.registration->T_world_sensor);
  };
  const bool may_be_right = used.is_valid && (is_poor(judged) || !is_poor(used));
  const auto are_right = [&] {
    return judged.is_valid && support_masks(beside, fit(judged), fit(used));
  };
  if (may_be_right && !are_right()) return used;
  cloud.overruled = std::move(overruled);
  return judged;
}

/// What recent views show at the predicted pose decides first which masks to follow, so that most
/// frames are registered once. The views are compared again at the estimated pose where that is
/// elsewhere, or poor, and only there in fast turns. Where too little may be left beside the masks,
/// a pose that ignores them is estimated, too; the masks are judged from the pose under which more
/// points are on known surfaces.
/// @param masked  share of the points
Odometry::Alignment PoseHypotheses::align_judged(const Odometry& odometry, LabeledCloud& cloud,
                                                 FeatureCloud features, double masked) const {
  const auto predicted = mask_check_.has_views() ? odometry.expected(cloud.stamp) : std::nullopt;
  weigh_masks_in_turn(odometry.turn_rate(), cloud);
  MaskEvidence early;
  if (predicted) early = mask_check_.compare(cloud, *predicted, MaskCheck::Points::kMasked);
  std::optional<Odometry::Alignment> checked;
  if (early.overruled_share >= kMinOverruledShare) {
    checked = align_overruled(odometry, cloud, early.overruled);
    if (is_poor(*checked)) {
      checked.reset();
      early = {};
    }
  }
  const double overruled = checked ? early.overruled_share : 0.0;
  Odometry::Alignment first = checked ? *std::move(checked) : odometry.align(std::move(features));
  if (!first.registration) {
    return masked <= kMuchMasked ? first : align_first(odometry, cloud, masked);
  }
  if (!mask_check_.has_views()) return first;
  const bool may_be_poor = is_poor(first) || masked - overruled > kMuchMasked;
  if (!may_be_poor && predicted && is_near(*predicted, pose_of(first))) {
    cloud.overruled = overruled > 0.0
                          ? std::move(early.overruled)
                          : points_of_overruled_clusters(cloud, std::move(early.overruled));
    return first;
  }
  return reconsider(odometry, cloud, std::move(first), overruled, may_be_poor);
}

/// @param first        overrules `cloud.overruled`, `overruled` of the points; none if that is 0
/// @param may_be_poor  whether all masks may be wrong
Odometry::Alignment PoseHypotheses::reconsider(const Odometry& odometry, LabeledCloud& cloud,
                                               Odometry::Alignment first, double overruled,
                                               bool may_be_poor) const {
  MaskEvidence evidence = mask_check_.compare(
      cloud, pose_of(first), may_be_poor ? MaskCheck::Points::kAll : MaskCheck::Points::kMasked);
  const bool in_doubt =
      may_be_poor && (is_poor(first) || evidence.masked_agreement > kMinMaskedAgreement);
  std::optional<Odometry::Alignment> ignoring;
  bool is_better = false;  // `ignoring` than `first`
  if (in_doubt) {
    ignoring = align_overruled(odometry, cloud, dynamic_points(cloud));
    MaskEvidence other = mask_check_.compare(cloud, pose_of(*ignoring));
    ignoring->is_valid = ignoring->is_valid && other.supported_share > kMinSupported;
    if (other.supported_share > kMinSupportGain * evidence.supported_share) {
      evidence = std::move(other);
      is_better = ignoring->is_valid;
    }
  }
  if (evidence.overruled_share >= overruled + kMinOverruledShare) {
    Odometry::Alignment checked = align_overruled(odometry, cloud, evidence.overruled);
    if (!checked.is_valid) checked.is_valid = explains_more(checked, first);
    if (checked.is_valid) return checked;
  }
  if (is_better || (!first.is_valid && ignoring && ignoring->is_valid)) {
    cloud.overruled = dynamic_points(cloud);
    return *std::move(ignoring);
  }
  if (!first.is_valid) evidence.overruled = {};
  cloud.overruled = overruled > 0.0
                        ? std::move(evidence.overruled)
                        : points_of_overruled_clusters(cloud, std::move(evidence.overruled));
  return first;
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
