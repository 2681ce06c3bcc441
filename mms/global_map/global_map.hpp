#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/geometry/sensor_noise.hpp"
#include "mms/global_map/graph/loop_confirmation.hpp"
#include "mms/global_map/graph/loop_graph.hpp"
#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/global_map/keyframes/local_scans.hpp"
#include "mms/global_map/loops/loop.hpp"
#include "mms/global_map/loops/loop_verification.hpp"
#include "mms/global_map/loops/lost_verification.hpp"
#include "mms/global_map/loops/scan_place.hpp"
#include "mms/global_map/places/place_recognizer.hpp"
#include "mms/global_map/pose_correction.hpp"
#include "mms/global_map/relocalizer.hpp"
#include "mms/localization/features/feature_extractor.hpp"
#include "mms/localization/odometry.hpp"
#include "mms/localization/registration/registration.hpp"
#include "mms/mapping/static_map/keyframe_selector.hpp"

namespace mms {

struct GlobalMapConfig {
  bool enabled = true;
  KeyframeConfig keyframes{.translation = 0.25, .rotation = 15.0, .max_interval = 3600.0};
  KeyframeConfig scan_keyframes{.translation = 0.5, .rotation = 15.0, .max_interval = 3600.0};
  double min_path = 5.0;  ///< [m]
  LoopConfig loops{};

  void visit(ConfigVisitor& v) {
    v.boolean({"enabled", "", "find loops and correct the trajectory by a pose graph"}, enabled);
    v.group({"keyframes", "", "choice of the nodes of the pose graph"}, keyframes);
    v.group({"scan_keyframes", "", "the same of LiDAR scans"}, scan_keyframes);
    v.number({"min_path", "m", "least length of the path between the ends of a loop"}, min_path,
             {0.0, 1e5});
    v.group({"loops", "", "checks of a loop"}, loops);
  }
};

/// A keyframe for the global map.
struct GlobalKeyframe {
  Image<Rgb> color;    ///< image of the frame; may be empty
  LabeledCloud cloud;  ///< a scan is as if all its points were measured at its stamp
  Transform<World, Sensor> T_world_sensor;  ///< by odometry
  bool after_lost = false;    ///< whether the sensor was lost since the keyframe before
  bool has_pose = false;      ///< of a lost sensor: whether the odometry found a pose, in doubt
  std::uint32_t session = 0;  ///< of the run; its world is that of the odometry since it began
  /// Where a user says that the sensor is.
  std::optional<Transform<Global, Sensor>> expected_place{};
};

/// Content of a global map, for map files. Sessions are numbered from 0 in the order of the
/// records.
struct GlobalMapContent {
  std::deque<KeyframeRecord> records;
  std::vector<Eigen::Isometry3d> poses;  ///< corrected, by record
  std::vector<Loop> loops;               ///< all that were checked, in order
};

/// Correction of a session by the loops of a map, see `GlobalMap::correction`.
/// @param poses  by record
PoseCorrection session_correction(const std::deque<KeyframeRecord>& records,
                                  const std::vector<Eigen::Isometry3d>& poses,
                                  const std::vector<Loop>& loops, std::uint32_t session);

/// Whether later keyframes may correct an earlier map.
enum class MapUse { kExtend, kLocalizeOnly };

/// Pose of a lost frame at a place of the global map.
struct Relocalization {
  Transform<World, Sensor> T_world_sensor;   ///< in the world of the session
  std::vector<PlacedFeatures> surroundings;  ///< features of the keyframes at that place
  /// Whether no loop joins the present session to that place: then a new session begins there,
  /// whose world is the frame of that place.
  bool begins_session = false;
  std::optional<Transform<Global, World>> T_global_world;  ///< of the new session, if it is known
};

/// The global map (beyond the paper, which names global optimization without a method): keyframes,
/// loops between them, and the pose graph that corrects the drift of the odometry. The odometry is
/// not changed by it. Deterministic for the same sequence of keyframes.
class GlobalMap {
 public:
  /// @param features, registration  settings of the odometry
  GlobalMap(const GlobalMapConfig& config, const FeatureConfig& features,
            const RegistrationConfig& registration);

  /// Takes an earlier map before the first keyframe. The keyframes that follow are a new session:
  /// the first loops to earlier ones give its place.
  void restore(GlobalMapContent content, MapUse use);

  /// Adds the next keyframe and checks loops to earlier ones. That of another session of the run
  /// begins a new one here.
  /// @returns the loops accepted with it
  std::vector<Loop> add(const GlobalKeyframe& keyframe);

  /// The same with a record, as those of another map; its session is that of the last one, or the
  /// next.
  /// @param expected  where a user says that it is, while its session is not in the map
  /// @param known     its loops, if others are not to be searched for, as where only the pose is
  /// kept
  std::vector<Loop> add(KeyframeRecord record,
                        const std::optional<Transform<Global, Sensor>>& expected = std::nullopt,
                        const std::vector<Loop>& known = {});

  /// Takes loops that another map has found between keyframes that were added.
  void join(const std::vector<Loop>& known) { graph_.solve_if_needed(take(known)); }

  /// Brings the poses up to date with all loops. After the last keyframe.
  void finish() { graph_.finish(); }

  /// Finds the place of a frame whose pose is lost or in doubt, see `Relocalizer`. Where it begins
  /// a session, the first keyframe of that must follow. If the frame becomes the next keyframe, its
  /// place is a loop of it.
  /// @returns nothing if it is not sure
  std::optional<Relocalization> relocalize(const GlobalKeyframe& frame);

  /// Correction of a session, or the present one, by all loops so far; empty without any.
  PoseCorrection correction(std::uint32_t session) const;
  PoseCorrection correction() const { return correction(session()); }

  /// Correction of the present session at its last keyframe; nothing until loops join it to an
  /// earlier map.
  std::optional<Transform<Global, World>> last_correction() const;

  /// Whether loops join a session to the first one, whose world is the frame of the map.
  bool is_joined(std::uint32_t session) const { return graph_.is_joined(session); }

  /// Whether loops join two sessions that have keyframes.
  bool share_frame(std::uint32_t a, std::uint32_t b) const { return graph_.share_frame(a, b); }

  /// Number of the session of the keyframes that are added.
  std::uint32_t session() const { return graph_.session(); }

  /// Number of the sessions of an earlier map; those of the run follow.
  std::uint32_t earlier_sessions() const { return earlier_sessions_; }

  /// Number here of a session of the run; nothing if it has no keyframe.
  std::optional<std::uint32_t> session_of_run(std::uint32_t session) const;

  /// All candidates that were checked, in order.
  const std::vector<Loop>& loops() const { return graph_.loops(); }
  const std::deque<KeyframeRecord>& records() const { return records_; }
  /// Corrected poses, by keyframe; the identity before the first one.
  const std::vector<Eigen::Isometry3d>& poses() const { return graph_.poses(); }

 private:
  /// The place of a lost frame.
  struct FoundPlace {
    Timestamp stamp;
    Loop loop;
  };

  KeyframeRecord record_of(const GlobalKeyframe& keyframe) const;
  KeyframeRecord record_of_lost(const GlobalKeyframe& frame) const;
  Relocalization relocalization_at(const Loop& loop, const std::vector<Eigen::Isometry3d>& poses);
  void describe_scan(const GlobalKeyframe& keyframe, KeyframeRecord& record);
  std::vector<Eigen::Isometry3d> poses_in_world() const;
  bool may_match(std::size_t candidate) const;
  bool has_enough_views(const KeyframeRecord& record, const std::vector<Loop>& accepted) const;
  bool is_place_known() const;
  bool is_sure(const Loop& place) const;
  std::vector<std::size_t> nearby(std::size_t end) const;
  std::vector<std::size_t> around(const Transform<Global, Sensor>& expected) const;
  std::vector<Loop> find_loop(const KeyframeRecord& record,
                              const std::optional<Transform<Global, Sensor>>& expected);
  std::vector<Loop> join_session(const KeyframeRecord& first);
  std::vector<Loop> take(const std::vector<Loop>& known);
  std::optional<Loop> place_of_scan(const KeyframeRecord& scan,
                                    const std::vector<Eigen::Isometry3d>& poses,
                                    const ScanPlaces::IsUsable& is_usable) const;

  GlobalMapConfig config_;
  FeatureExtractor extractor_;
  DepthNoise noise_;
  LoopVerifier verifier_;
  LostFrameVerifier lost_verifier_;
  LocalScans scans_;
  PlaceRecognizer recognizer_;
  ScanPlaces scan_places_;
  std::deque<KeyframeRecord> records_;
  LoopGraph graph_;
  LoopConfirmation confirmation_;
  Relocalizer relocalizer_;
  std::uint32_t earlier_sessions_ = 0;
  std::vector<std::uint32_t> run_sessions_;  ///< of the run that have keyframes, ascending
  std::optional<Loop> first_loop_;           ///< of the session that a relocalization begins
  std::optional<FoundPlace> found_place_;    ///< of the last frame, within the session
};

}  // namespace mms
