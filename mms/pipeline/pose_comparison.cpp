#include "mms/pipeline/pose_comparison.hpp"

namespace mms {
namespace {

/// [-]: ratio of the photometric residuals at both poses from which on the larger one is wrong.
/// Source: 2.4 to 3.8 among people; up to 2.0 under false masks, where few features fit.
constexpr double kMinResidualRatio = 1.5;

/// [-]: ratio of the features that fit at both poses, without images. Source: initial choice.
constexpr double kMinFitRatio = 1.2;

/// [-]: share of the features beside the masks that must fit at the pose that follows the masks.
/// Source: at least 0.55 among people.
constexpr double kMinFittingShare = 0.4;

/// [-]: their number. Source: at least 168 among people, at most 50 where false masks seemed right.
constexpr int kMinFitting = 100;

/// [-]: share of the features that must fit at a pose that seems infeasible. Source: 0.76 to 0.87
/// under false masks of `fr1_xyz_clip`.
constexpr double kNearlyAllFit = 0.75;

/// [-]: ratio of the features that fit at that pose and at another one. Source: 4 to 5 there.
constexpr double kMinGain = 2.0;

double offered_by(const FeatureCloud& features) {
  return static_cast<double>(features.edges.size() + features.planes.size());
}

}  // namespace

bool fits_better(const Odometry::Fit& fit, const Odometry::Fit& other) {
  if (fit.intensity_sigma > 0.0 && other.intensity_sigma > 0.0) {
    return other.intensity_sigma > kMinResidualRatio * fit.intensity_sigma;
  }
  return fit.inliers > kMinFitRatio * other.inliers;
}

bool support_masks(const FeatureCloud& beside, const Odometry::Fit& following,
                   const Odometry::Fit& ignoring) {
  return following.inliers >= kMinFitting &&
         following.inliers >= kMinFittingShare * offered_by(beside) &&
         fits_better(following, ignoring);
}

bool explains_more(const Odometry::Alignment& alignment, const Odometry::Alignment& other) {
  const int inliers = alignment.registration->geometric.inliers();
  return alignment.looks_right && alignment.registration->T_world_sensor.matrix().allFinite() &&
         alignment.registration->degenerate_directions == 0 &&
         inliers >= kNearlyAllFit * offered_by(alignment.features) &&
         inliers >= kMinGain * other.registration->geometric.inliers();
}

}  // namespace mms
