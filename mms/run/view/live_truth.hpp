#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "mms/core/trajectory.hpp"

namespace mms {

/// Ground-truth positions during a run, aligned by the first frame with ground truth.
class LiveTruth {
 public:
  explicit LiveTruth(Trajectory truth);

  bool empty() const { return truth_.empty(); }

  /// Ground-truth position at a frame in the frame of the estimate [m]; nullopt if none is close in
  /// time.
  std::optional<Eigen::Vector3d> at(const StampedPose& estimate);

  /// Moves the positions to come, as loops moved the frame that they are aligned by.
  void move(const Eigen::Isometry3d& T) {
    if (T_world_truth_) T_world_truth_ = T * *T_world_truth_;
  }

 private:
  Trajectory truth_;  // in order of time
  std::optional<Eigen::Isometry3d> T_world_truth_;
};

}  // namespace mms
