#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "mms/core/trajectory.hpp"

namespace mms {

/// True positions while a run goes on: the truth is put in place by the first frame that has one.
class LiveTruth {
 public:
  explicit LiveTruth(Trajectory truth);

  bool empty() const { return truth_.empty(); }

  /// True position at a frame in the frame of the estimate [m]; nothing where none is near in time.
  std::optional<Eigen::Vector3d> at(const StampedPose& estimate);

 private:
  Trajectory truth_;  // by time
  std::optional<Eigen::Isometry3d> T_world_truth_;
};

}  // namespace mms
