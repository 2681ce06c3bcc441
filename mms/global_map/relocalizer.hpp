#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/global_map/loops/loop.hpp"
#include "mms/global_map/loops/lost_verification.hpp"
#include "mms/global_map/places/place_recognizer.hpp"

namespace mms {

/// The keyframes among which the place of a lost frame is searched.
struct KnownPlaces {
  const std::deque<KeyframeRecord>& records;
  /// In the world of the present session; those that no loops join to it in a frame of their own.
  const std::vector<Eigen::Isometry3d>& poses;
  const PlaceRecognizer& recognizer;
  const LostFrameVerifier& verifier;
  std::function<bool(std::size_t keyframe)> is_usable;
  std::function<bool(std::size_t keyframe)> shares_frame;  ///< with the present session
  std::function<std::optional<Loop>(const KeyframeRecord&)> place_of_scan;
};

/// Finds the place of a lost sensor from frame to frame.
class Relocalizer {
 public:
  /// The place of the next frame. Two frames that are shortly after each other must agree. Where it
  /// is not recognized, views near the pose of the odometry can confirm that.
  /// @param has_pose  whether the odometry found a pose, in doubt
  /// @returns the keyframe and the pose relative to it; nothing if it is not sure
  std::optional<Loop> find(const KnownPlaces& places, const KeyframeRecord& frame, bool has_pose);

  /// Forgets the frames before.
  void reset() { *this = {}; }

 private:
  std::optional<StampedPose> recognized_;  ///< of the last recognized frame, not yet confirmed
  int confirmations_ = 0;                  ///< of the odometry's pose, by lost frames in a row
};

}  // namespace mms
