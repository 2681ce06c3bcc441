#include "mms/localization/motion/wheel_odometry.hpp"

#include <algorithm>
#include <iterator>

#include "mms/geometry/se3.hpp"
#include "mms/localization/motion/sample_times.hpp"

namespace mms {

void WheelOdometry::add(const std::vector<WheelSample>& samples, Duration delay) {
  for (const WheelSample& sample : samples) {
    const Timestamp stamp = sample.stamp - delay;
    if (!sample.T_odom_base.is_finite()) continue;
    if (samples_.empty() || stamp > samples_.back().stamp) {
      samples_.push_back({stamp, sample.T_odom_base});
    }
  }
  forget_old(samples_);
}

std::optional<Eigen::Isometry3d> WheelOdometry::pose_at(Timestamp stamp) const {
  const auto pair = samples_around(samples_, stamp);
  if (!pair) return std::nullopt;
  const Eigen::Isometry3d& before = pair->before->T_odom_base.isometry();
  const Eigen::Isometry3d step = before.inverse() * pair->after->T_odom_base.isometry();
  return before * se3::interpolate(step, pair->share);
}

std::optional<WheelOdometry::Motion> WheelOdometry::between(Timestamp from, Timestamp to,
                                                            Duration shift) const {
  if (to < from) {
    auto reverse = between(to, from, shift);
    if (reverse) reverse->T_from_to = reverse->T_from_to.inverse();
    return reverse;
  }
  const Timestamp first = from + shift;
  const Timestamp last = to + shift;
  const auto begin = pose_at(first);
  const auto end = pose_at(last);
  if (!begin || !end || has_gap(samples_, first, last)) return std::nullopt;
  Motion motion;
  motion.T_from_to = begin->inverse() * *end;
  Eigen::Isometry3d before = *begin;
  const auto step_to = [&](const Eigen::Isometry3d& pose) {
    const Eigen::Isometry3d step = before.inverse() * pose;
    motion.way += step.translation().norm();
    motion.turn += se3::angle(step);
    before = pose;
  };
  for (auto sample = first_after(samples_, first); sample != samples_.end() && sample->stamp < last;
       ++sample) {
    step_to(sample->T_odom_base.isometry());
  }
  step_to(*end);
  return motion;
}

}  // namespace mms
