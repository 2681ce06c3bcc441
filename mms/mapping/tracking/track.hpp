#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mms/core/object_box.hpp"
#include "mms/mapping/tracking/box_fit.hpp"
#include "mms/mapping/tracking/motion_filter.hpp"
#include "mms/mapping/tracking/object_measurement.hpp"
#include "mms/mapping/tracking/track_config.hpp"

namespace mms {

/// Whether an object of the dynamic map was seen in the last frame.
enum class TrackState {
  kActive,
  kCoasting,  ///< not seen; its position is predicted
};

/// One dynamic object over time, in the world frame: a box with heading and size estimated from all
/// views, and a motion.
class Track {
 public:
  Track(int id, const ObjectMeasurement& first, const GroundFrame& ground,
        const TrackConfig& config);

  /// Replaces the upright axis and the floor.
  void set_ground(const GroundFrame& ground);

  /// Predicts the motion up to a stamp, not earlier than the last.
  void predict(Timestamp stamp);

  /// The box that a measurement gives, if it is of this object.
  BoxFit fit(const ObjectMeasurement& object) const { return fit(object, motion_.position()); }

  /// Updates the track with a measurement of its object.
  /// @param shared  whether the measurement covers another object too: its position is then
  ///                uncertain, and shape and appearance are not learned from it
  void update(const ObjectMeasurement& object, bool shared);

  /// Makes the track an object until it is deleted.
  void confirm() { confirmed_ = true; }

  /// Takes over the id, the class and the size of a lost track of the same object.
  void continue_as(const Track& lost);
  bool confirmed() const { return confirmed_; }

  int id() const { return id_; }
  int observations() const { return observations_; }            ///< views with a mask
  int motion_detections() const { return motion_detections_; }  ///< views without a mask, in motion
  Timestamp first_seen() const { return first_seen_; }
  Timestamp last_seen() const { return last_seen_; }
  Eigen::Vector3d last_position() const { return last_position_; }  ///< at last_seen
  /// Stamp of the last view with a mask or in motion.
  Timestamp last_evidence() const { return last_evidence_; }
  Eigen::Vector3d position() const { return motion_.position(); }
  Eigen::Matrix3d position_covariance() const { return motion_.position_covariance(); }
  const MotionFilter& motion() const { return motion_; }
  const Eigen::Vector3d& size() const { return size_; }
  const Appearance& appearance() const { return appearance_; }
  double score() const { return score_; }  ///< mean over the last observations, in [0, 1]
  ObjectClass object_class() const;        ///< the class of most masks

  ObjectBox box() const;

  /// True for a point of the world in the box grown by `margin` [m] on every side.
  bool contains(const Eigen::Vector3d& point, double margin) const;

 private:
  BoxFit fit(const ObjectMeasurement& object, const std::optional<Eigen::Vector3d>& expected) const;
  void update_class(const ObjectMeasurement& object);
  void add_view(const ObjectMeasurement& object, bool shared);
  PositionError error_of(const ObjectMeasurement& object, bool is_unanchored) const;
  void learn_shape(const ObjectMeasurement& object);
  void learn_size(const BoxFit& fit);
  void learn_heading(const ObjectMeasurement& object);

  TrackConfig config_;
  GroundFrame ground_;
  int id_;
  int observations_ = 0;
  int motion_detections_ = 0;
  double score_ = 0.0;
  bool confirmed_ = false;
  Timestamp first_seen_;
  Timestamp last_seen_;
  Timestamp last_evidence_;
  Timestamp predicted_;
  Eigen::Vector3d last_position_;
  std::array<int, kObjectClassCount> votes_{};
  MotionFilter motion_;
  double heading_ = 0.0;
  bool has_heading_ = false;
  bool moving_ = false;
  Eigen::Vector3d size_;
  std::array<int, 3> whole_views_{};  ///< by axis: measurements with both ends in view
  Appearance appearance_;
};

}  // namespace mms
