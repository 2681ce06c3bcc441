#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/localization/odometry.hpp"
#include "mms/localization/robot_body/depth_view.hpp"
#include "mms/localization/robot_body/known_parts.hpp"
#include "mms/localization/robot_body/robot_body_config.hpp"

namespace mms {

/// Parts of the robot that the depth camera sees: a bumper, an arm, a load (beyond the paper). They
/// stay where they are in the image, as if the camera did not move, and would hold the pose. Found
/// by comparing images with an earlier one: near nodes of constant depth and brightness are parts
/// of the robot if they contradict the motion of the rest, or if the rest contradicts a pose that
/// they hold. Nothing is known before the robot moves.
class RobotBody {
 public:
  RobotBody(const RobotBodyConfig& config, const DepthNoise& noise)
      : config_(config), noise_(noise) {}

  /// Makes the points of known parts invalid.
  void exclude(LabeledCloud& cloud, FeatureCloud& features) { parts_.exclude(cloud, features); }

  /// Share of the image that is known to show the robot, in [0, 1].
  double share() const { return parts_.share(); }

  /// A frame as far as `search` needs it.
  struct SeenFrame {
    DepthView view;
    FeatureCloud features;
  };

  /// Keeps what a frame shows for `search`, if that can be a part of the robot: after `exclude`,
  /// before moving points are excluded.
  std::optional<SeenFrame> see(const LabeledCloud& cloud, const FeatureCloud& features) const;

  /// An odometry that ignores a part which held the pose.
  struct Correction {
    Odometry odometry;
    OdometryEstimate estimate;  ///< of the frame
  };

  struct Found {
    bool is_new = false;  ///< whether another part was found
    std::optional<Correction> correction{};
  };

  /// Adds measurements of wheels and gyroscope, as `Odometry::sense`.
  void sense(const MotionSamples& samples, const MotionCalibration& calibration);

  /// Searches for parts with the next frame.
  /// @param frame     by `see`; without one, the search begins anew
  /// @param odometry  after the frame
  Found search(const std::optional<SeenFrame>& frame, const Odometry& odometry,
               const OdometryEstimate& estimate);

  /// Where the pose jumps, frames before are not compared any more.
  void restart() { reference_.reset(); }

 private:
  /// An odometry without constant nodes, beside the one of the run.
  struct Ignoring {
    Odometry at_reference;
    Odometry odometry;
    Transform<World, Sensor> T_world_reference;
    Timestamp since;
    OdometryEstimate estimate{};
  };

  /// The earlier frame that others are compared with.
  struct Reference {
    SeenFrame frame;
    Odometry odometry;  ///< that begins anew with it
    OdometryEstimate estimate;
    Image<std::uint8_t> constant;  ///< nodes that were constant since
    int nodes = 0;                 ///< their number
    std::optional<Ignoring> ignoring{};
  };

  Image<std::uint8_t> near_nodes(const DepthView& view) const;
  bool is_over(const DepthView& view, const OdometryEstimate& estimate) const;
  Found compare(const SeenFrame& frame, const OdometryEstimate& estimate);
  void begin(const SeenFrame& frame, const Odometry& odometry, const OdometryEstimate& estimate);
  void keep_constant(const DepthView& view);
  bool has_changed(const DepthView& view) const;
  bool ignore_constant(const SeenFrame& frame, Timestamp stamp);
  bool is_supported(const SeenFrame& frame, const Eigen::Isometry3d& T_reference_now) const;
  bool is_contradicted(const DepthView& view, const Eigen::Isometry3d& T_reference_now) const;
  void end(Timestamp stamp);

  RobotBodyConfig config_;
  DepthNoise noise_;
  KnownParts parts_;
  std::optional<Reference> reference_;
  Duration interval_ = Duration::zero();  // between two reference frames
  Timestamp last_end_;                    // of one
};

}  // namespace mms
