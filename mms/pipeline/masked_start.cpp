#include "mms/pipeline/masked_start.hpp"

#include <chrono>
#include <utility>

#include "mms/geometry/se3.hpp"
#include "mms/pipeline/pose_comparison.hpp"

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
  if (support_masks(placed, own, other)) return Verdict::kMasksAreRight;
  return fits_better(other, own) ? Verdict::kMasksAreWrong : Verdict::kOpen;
}

}  // namespace mms
