#include "mms/fusion/masks/mask_weight.hpp"

#include <algorithm>
#include <cstddef>

#include "mms/geometry/image_blur.hpp"

namespace mms {
namespace {

/// [-]: factor of the weight for each reason to doubt a mask. Source: initial choice.
constexpr float kDoubt = 0.5F;

/// [s]: time for which a mask was followed from which on blur and turns are no doubt. Source: the
/// network is wrong in bursts of blurred frames; people stay.
constexpr double kFollowed = 1.0;

/// [-]: `image_blur` of a blurred image. Source: medians of three recordings at half of 640 x 480:
/// 0.30 as recorded, 0.38 with a blur of 5 px, 0.52 with one of 9 px.
constexpr double kBlurred = 0.45;

/// [rad/s]: a fast turn. Source: as `kMaxExpectedTurnRate` of the odometry.
constexpr double kFastTurn = 0.5;

bool is_new(const DynamicCluster& cluster) {
  return cluster.followed < kFollowed;
}

void doubt_new_masks(LabeledCloud& cloud) {
  for (DynamicCluster& cluster : cloud.clusters) {
    if (is_new(cluster)) cluster.weight *= kDoubt;
  }
}

}  // namespace

void weigh_masks(const std::vector<Plausibility>& judged, LabeledCloud& cloud) {
  for (DynamicCluster& cluster : cloud.clusters) {
    const auto instance = static_cast<std::size_t>(cluster.instance);
    const bool is_doubtful =
        instance < judged.size() && judged[instance] == Plausibility::kDoubtful;
    if (is_doubtful) cluster.weight *= kDoubt;
  }
  const bool are_any_new = std::any_of(cloud.clusters.begin(), cloud.clusters.end(), is_new);
  if (!are_any_new || cloud.colors.empty()) return;
  if (image_blur(cloud.colors, cloud.width, cloud.height) > kBlurred) doubt_new_masks(cloud);
}

void weigh_masks_in_turn(double turn_rate, LabeledCloud& cloud) {
  if (turn_rate > kFastTurn) doubt_new_masks(cloud);
}

}  // namespace mms
