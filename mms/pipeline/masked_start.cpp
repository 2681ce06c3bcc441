#include "mms/pipeline/masked_start.hpp"

#include <chrono>
#include <utility>

#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

/// [s]: time within which both odometries must disagree. Source: initial choice; people and sensor
/// rarely all stand still for longer.
constexpr Duration kMaxTime = std::chrono::seconds(10);

/// [m]: distance of their poses from which on they disagree. Source: far above the errors of a pose
/// from few points (2 cm); the points beside the masks differ clearly then.
constexpr double kMinDistance = 0.1;

/// [rad]: the same of the angle. Source: as `kMinDistance`, 3 degrees.
constexpr double kMinTurn = 0.05;

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

/// Whether a pose fits clearly better than another one.
bool is_better(const Odometry::Fit& fit, const Odometry::Fit& other) {
  if (fit.intensity_sigma > 0.0 && other.intensity_sigma > 0.0) {
    return other.intensity_sigma > kMinResidualRatio * fit.intensity_sigma;
  }
  return fit.inliers > kMinFitRatio * other.inliers;
}

}  // namespace

MaskedStart::Verdict MaskedStart::add(FeatureCloud features, const OdometryEstimate& ignoring) {
  Odometry::Alignment alignment = following_.align(std::move(features));
  const FeatureCloud placed = alignment.features;
  estimate_ = following_.accept(std::move(alignment));
  if (!first_) {
    first_ = following_;
    begin_ = estimate_.stamp;
    return Verdict::kOpen;
  }
  if (estimate_.status == Status::kLost) return Verdict::kMasksAreWrong;
  if (estimate_.stamp - begin_ > kMaxTime) return Verdict::kMasksAreWrong;
  const Eigen::Isometry3d difference =
      (estimate_.T_world_sensor.inverse() * ignoring.T_world_sensor).isometry();
  const bool disagree =
      difference.translation().norm() > kMinDistance || se3::angle(difference) > kMinTurn;
  if (!disagree) return Verdict::kOpen;
  const Odometry::Fit own = first_->fit(placed, estimate_.T_world_sensor.isometry());
  const Odometry::Fit other = first_->fit(placed, ignoring.T_world_sensor.isometry());
  const double offered = static_cast<double>(placed.edges.size() + placed.planes.size());
  const bool fits = own.inliers >= kMinFitting && own.inliers >= kMinFittingShare * offered;
  if (fits && is_better(own, other)) return Verdict::kMasksAreRight;
  return is_better(other, own) ? Verdict::kMasksAreWrong : Verdict::kOpen;
}

}  // namespace mms
