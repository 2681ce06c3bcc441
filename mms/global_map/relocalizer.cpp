#include "mms/global_map/relocalizer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

/// [-]: candidates of a lost frame by place recognition. Source: the right place was among the
/// first three wherever it was among the first ten.
constexpr std::size_t kMaxRecognized = 3;

/// [-]: candidates by the pose of the odometry. Source: computing time.
constexpr std::size_t kMaxNear = 2;

/// [m]: distance of the places of two lost frames that the errors of their poses explain.
/// Source: initial choice.
constexpr double kMaxStep = 0.1;

/// [rad]: the same of the angle. Source: initial choice, 5 degrees.
constexpr double kMaxStepTurn = 5.0 * std::numbers::pi / 180.0;

/// [m/s]: largest speed between two lost frames. Source: initial choice, a person who walks fast.
constexpr double kMaxSpeed = 2.0;

/// [rad/s]: largest turn rate between two lost frames. Source: initial choice, half a turn a
/// second.
constexpr double kMaxTurnRate = std::numbers::pi;

/// [m, rad]: sum of the distance and the angle of keyframes whose views can confirm a pose. Source:
/// initial choice; views beyond share too little.
constexpr double kMaxDoubtDistance = 2.0;

/// [-]: frames in a row that confirm the pose of the odometry where the place is not recognized.
/// Source: two frames recognize a place; before six, structures that repeat misled the odometry.
constexpr int kConfirmations = 6;

/// [s]: time between two frames that are recognized, beyond which they do not confirm each other.
/// Source: the sensor may have moved to the next rack.
constexpr double kMaxGap = 0.4;

/// Whether a sensor can move from one pose to the other.
bool can_move(const StampedPose& before, const StampedPose& now) {
  const double seconds = std::abs(to_seconds(now.stamp - before.stamp));
  if (seconds > kMaxGap) return false;
  const Eigen::Isometry3d motion =
      (before.T_world_sensor.inverse() * now.T_world_sensor).isometry();
  return motion.translation().norm() < kMaxStep + kMaxSpeed * seconds &&
         se3::angle(motion) < kMaxStepTurn + kMaxTurnRate * seconds;
}

/// The place of a lost frame by its keypoints, the candidate with most of them, or as a scan.
std::optional<Loop> recognize(const KnownPlaces& places, const KeyframeRecord& frame) {
  if (frame.is_scan()) return places.place_of_scan(frame);
  std::optional<Loop> best;
  for (const PlaceCandidate& candidate : places.recognizer.find(
           frame.keypoints.descriptors, places.records.size(), kMaxRecognized, places.is_usable)) {
    Loop loop = places.verifier.verify(places.records, places.poses, candidate.keyframe, frame);
    if (loop.outcome != LoopOutcome::kAccepted) continue;
    if (!best || loop.inliers > best->inliers) best = std::move(loop);
  }
  return best;
}

/// Whether a view near the pose of the odometry confirms it.
std::optional<Loop> confirm(const KnownPlaces& places, const KeyframeRecord& frame) {
  const Eigen::Isometry3d& pose = frame.T_world_sensor.isometry();
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < places.poses.size(); ++i) {
    const Eigen::Isometry3d relative = places.poses[i].inverse() * pose;
    const double distance = relative.translation().norm() + se3::angle(relative);
    const bool may_confirm = places.is_usable(i) && places.shares_frame(i);
    if (distance < kMaxDoubtDistance && may_confirm) near.emplace_back(distance, i);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), kMaxNear));
  for (const auto& [unused, i] : near) {
    Loop loop = places.verifier.verify_nearby(places.records, places.poses, i, frame,
                                              places.poses[i].inverse() * pose);
    if (loop.outcome == LoopOutcome::kAccepted) return loop;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Loop> Relocalizer::find(const KnownPlaces& places, const KeyframeRecord& frame,
                                      bool has_pose) {
  if (std::optional<Loop> loop = recognize(places, frame)) {
    confirmations_ = 0;
    const StampedPose pose{frame.stamp, Transform<World, Sensor>(places.poses[loop->candidate] *
                                                                 loop->T_candidate_query)};
    const std::optional<StampedPose> before = std::exchange(recognized_, pose);
    if (before && can_move(*before, pose)) return loop;
    return std::nullopt;
  }
  std::optional<Loop> loop = has_pose ? confirm(places, frame) : std::nullopt;
  confirmations_ = loop ? confirmations_ + 1 : 0;
  if (confirmations_ < kConfirmations) return std::nullopt;
  return loop;
}

}  // namespace mms
