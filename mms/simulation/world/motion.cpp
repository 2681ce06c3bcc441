#include "mms/simulation/world/motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mms {
namespace {

std::array<double, 4> values_at(double u) {
  const double w = 1.0 - u;
  return {w * w * w / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
          (-3.0 * u * u * u + 3.0 * u * u + 3.0 * u + 1.0) / 6.0, u * u * u / 6.0};
}

std::array<double, 4> slopes_at(double u) {
  const double w = 1.0 - u;
  return {-0.5 * w * w, 1.5 * u * u - 2.0 * u, -1.5 * u * u + u + 0.5, 0.5 * u * u};
}

}  // namespace

Motion::Motion(std::vector<MotionKnot> knots, double interval)
    : knots_(std::move(knots)), interval_(interval) {}

Motion Motion::still(const Eigen::Vector2d& position, double yaw) {
  return Motion({{position, yaw, 0.0}}, 1.0);
}

Motion::Place Motion::place(double seconds) const {
  const double last = static_cast<double>(knots_.size()) + 1.0;
  const double at = std::clamp(seconds / interval_ + 1.0, 0.0, last);
  const double whole = std::min(std::floor(at), last - 1.0);
  return {static_cast<std::size_t>(whole), at - whole};
}

const MotionKnot& Motion::knot(std::size_t index) const {
  // Two copies of the end knots on either side make the velocity zero there.
  return knots_[std::clamp<std::size_t>(index, 2, knots_.size() + 1) - 2];
}

template <class Value, class Get>
Value Motion::blend(std::size_t first, const Weights& weights, const Value& zero,
                    const Get& get) const {
  Value sum = zero;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * get(knot(first + i));
  return sum;
}

Eigen::Vector2d Motion::position(double seconds) const {
  const Place at = place(seconds);
  return blend(at.first, values_at(at.u), Eigen::Vector2d(0.0, 0.0),
               [](const MotionKnot& k) { return k.position; });
}

Eigen::Vector2d Motion::velocity(double seconds) const {
  const Place at = place(seconds);
  const Eigen::Vector2d slope = blend(at.first, slopes_at(at.u), Eigen::Vector2d(0.0, 0.0),
                                      [](const MotionKnot& k) { return k.position; });
  return slope / interval_;
}

double Motion::yaw(double seconds) const {
  const Place at = place(seconds);
  return blend(at.first, values_at(at.u), 0.0, [](const MotionKnot& k) { return k.yaw; });
}

double Motion::travelled(double seconds) const {
  const Place at = place(seconds);
  return blend(at.first, values_at(at.u), 0.0, [](const MotionKnot& k) { return k.travelled; });
}

Eigen::Isometry3d Motion::T_world_object(double seconds) const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(yaw(seconds), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation().head<2>() = position(seconds);
  return T;
}

}  // namespace mms
