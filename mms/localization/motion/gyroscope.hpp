#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>
#include <vector>

#include "mms/core/motion_samples.hpp"

namespace mms {

/// Recent rates of a gyroscope, integrated without its bias, which is estimated from turns that are
/// known from elsewhere (as in preintegration, Forster et al., T-RO 2017).
class Gyroscope {
 public:
  /// Turn of the gyroscope between two times.
  struct Turn {
    Eigen::Matrix3d R_from_to = Eigen::Matrix3d::Identity();
    double angle = 0.0;  ///< sum of all turns [rad]
  };

  Gyroscope();

  /// Measurements that do not follow the last one are left out.
  /// @param delay  of their stamps
  void add(const std::vector<ImuSample>& samples, Duration delay);

  /// Without measurements around both times, or with a gap between them: nothing. Shortly after the
  /// last measurement, the rate is expected to stay.
  /// @param shift  added to both times
  std::optional<Turn> between(Timestamp from, Timestamp to, Duration shift = Duration(0)) const;

  /// Corrects the bias by a turn in the gyroscope's frame. Turns that contradict it are ignored.
  /// @param sigma  its standard deviation about each axis [rad]
  /// @param shift  added to both times
  void correct_bias(Timestamp from, Timestamp to, const Eigen::Matrix3d& R_from_to, double sigma,
                    Duration shift = Duration(0));

  /// Lets the bias be estimated anew.
  void forget_bias();

  /// Standard deviation of the bias about each axis [rad/s].
  double bias_sigma() const { return bias_sigma_; }
  const Eigen::Vector3d& bias() const { return bias_; }  ///< [rad/s]

  bool empty() const { return samples_.empty(); }

 private:
  std::optional<Eigen::Vector3d> rate_at(Timestamp stamp) const;

  std::deque<ImuSample> samples_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  double bias_sigma_;
};

}  // namespace mms
