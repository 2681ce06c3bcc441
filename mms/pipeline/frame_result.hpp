#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/mapping/tracking/dynamic_map.hpp"
#include "mms/pipeline/correction_feed.hpp"

namespace mms {

/// The steps of a frame that are timed.
enum class Stage { kSegmentation, kFusion, kFeatures, kOdometry, kMapping };

/// [-]: the number of them. Source: `Stage`.
inline constexpr std::size_t kStageCount = 5;

constexpr std::string_view to_string(Stage stage) {
  constexpr std::array<std::string_view, kStageCount> kNames = {"segmentation", "fusion",
                                                                "features", "odometry", "mapping"};
  return kNames[static_cast<std::size_t>(stage)];
}

/// Duration of every stage of one frame [ms].
using StageTimes = std::array<double, kStageCount>;

/// What `SlamSystem::process` gives back of one frame.
struct FrameResult {
  OdometryEstimate odometry;
  LabeledCloud cloud;
  std::uint32_t session = 0;     ///< of the run; one that begins after a loss has the next
  bool begins_anew = false;      ///< the first scan was skewed: maps begin with this one
  bool keyframe = false;         ///< of the static map
  bool global_keyframe = false;  ///< of the global map
  /// Of a global keyframe: frames since the last one were lost, or it is at a recognized place.
  bool after_lost = false;
  bool wants_relocalization = false;  ///< lost before, and its place is not recognized yet
  bool has_pose_in_doubt = false;     ///< of these: the odometry found a pose
  MapCorrection correction;           ///< known to loop closure so far
  /// By a user, and the odometry since: where the place in the map is searched for.
  std::optional<Transform<Global, Sensor>> expected_place;
  bool relocalized = false;            ///< the pose is that of a recognized place
  double dynamic_share = 0.0;          ///< of the valid points, in [0, 1]
  double overruled_share = 0.0;        ///< of the valid points: masked, but static for the pose
  std::vector<TrackedObject> objects;  ///< of the dynamic map, by id
  std::vector<std::string> warnings;   ///< about wheels and gyroscope, one line each
  StageTimes stage_ms{};

  /// Whether the pose is not known, since the place after a loss is not recognized yet.
  bool is_searching() const { return wants_relocalization && odometry.status == Status::kLost; }
};

}  // namespace mms
