#include "mms/localization/motion/gyroscope.hpp"

#include <algorithm>
#include <cmath>

#include "mms/geometry/se3.hpp"
#include "mms/localization/motion/sample_times.hpp"

namespace mms {
namespace {

/// [rad/s]: standard deviation of the bias before anything is known of it.
/// Source: offset of consumer sensors, 1 degree/s (Bosch BMI055 data sheet).
constexpr double kFirstBiasSigma = 0.017;

/// [-]: standard deviations by which a turn may differ from the one that is measured.
/// Source: 1 % of a normal distribution in three dimensions is beyond.
constexpr double kMaxBiasSigmas = 3.4;

/// [rad/s]: standard deviation of the change of the bias after one second.
/// Source: ten times the drift of Bosch BMI055 that `ImuConfig` simulates, for warming up.
constexpr double kBiasWalk = 0.001;

Eigen::Matrix3d rotation_by(const Eigen::Vector3d& angles) {
  Vector6d tangent = Vector6d::Zero();
  tangent.tail<3>() = angles;
  return se3::exp(tangent).linear();
}

Eigen::Vector3d angles_of(const Eigen::Matrix3d& rotation) {
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() = rotation;
  return se3::log(turn).tail<3>();
}

}  // namespace

Gyroscope::Gyroscope() : bias_sigma_(kFirstBiasSigma) {}

void Gyroscope::add(const std::vector<ImuSample>& samples, Duration delay) {
  for (const ImuSample& sample : samples) {
    const Timestamp stamp = sample.stamp - delay;
    if (!sample.rate.allFinite()) continue;
    if (samples_.empty() || stamp > samples_.back().stamp) {
      samples_.push_back({stamp, sample.rate, sample.acceleration});
    }
  }
  forget_old(samples_);
}

std::optional<Eigen::Vector3d> Gyroscope::rate_at(Timestamp stamp) const {
  const auto pair = samples_around(samples_, stamp);
  if (!pair) return std::nullopt;
  const double share = std::min(pair->share, 1.0);
  return (1.0 - share) * pair->before->rate + share * pair->after->rate;
}

std::optional<Gyroscope::Turn> Gyroscope::between(Timestamp from, Timestamp to,
                                                  Duration shift) const {
  if (to < from) {
    auto reverse = between(to, from, shift);
    if (reverse) reverse->R_from_to.transposeInPlace();
    return reverse;
  }
  const Timestamp first = from + shift;
  const Timestamp last = to + shift;
  const auto begin = rate_at(first);
  const auto end = rate_at(last);
  if (!begin || !end || has_gap(samples_, first, last)) return std::nullopt;
  Turn turn;
  Timestamp before = first;
  Eigen::Vector3d rate_before = *begin;
  const auto step_to = [&](Timestamp stamp, const Eigen::Vector3d& rate) {
    const Eigen::Vector3d angles =
        to_seconds(stamp - before) * (0.5 * (rate_before + rate) - bias_);
    turn.R_from_to = turn.R_from_to * rotation_by(angles);
    turn.angle += angles.norm();
    before = stamp;
    rate_before = rate;
  };
  for (auto sample = first_after(samples_, first); sample != samples_.end() && sample->stamp < last;
       ++sample) {
    step_to(sample->stamp, sample->rate);
  }
  step_to(last, *end);
  return turn;
}

/// A Kalman filter of one variance, equal about all axes.
void Gyroscope::correct_bias(Timestamp from, Timestamp to, const Eigen::Matrix3d& R_from_to,
                             double sigma, Duration shift) {
  const double seconds = to_seconds(to - from);
  const auto turn = between(from, to, shift);
  if (!turn || seconds <= 0.0) return;
  const Eigen::Vector3d excess = angles_of(R_from_to.transpose() * turn->R_from_to) / seconds;
  const double walked = bias_sigma_ * bias_sigma_ + kBiasWalk * kBiasWalk * seconds;
  const double noise = sigma / seconds;
  const double variance = walked + noise * noise;
  if (excess.norm() > kMaxBiasSigmas * std::sqrt(variance)) return;
  const double gain = walked / variance;
  bias_ += gain * excess;
  bias_sigma_ = std::sqrt((1.0 - gain) * walked);
}

void Gyroscope::forget_bias() {
  bias_.setZero();
  bias_sigma_ = kFirstBiasSigma;
}

}  // namespace mms
