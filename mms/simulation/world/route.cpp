#include "mms/simulation/world/route.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mms/core/hash_noise.hpp"

namespace mms {
namespace {

constexpr double kStep = 0.05;    // simulation step [s]
constexpr int kStepsPerKnot = 4;  // one knot per 0.2 s

double wrapped(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

/// The corners in order of passage, once.
std::vector<Eigen::Vector2d> unrolled(const Route& route) {
  std::vector<Eigen::Vector2d> way = route.corners;
  if (route.end == RouteEnd::kLoop) way.push_back(way.front());
  if (route.end == RouteEnd::kToAndFro) {
    way.insert(way.end(), route.corners.rbegin() + 1, route.corners.rend());
  }
  return way;
}

double length_of(const std::vector<Eigen::Vector2d>& way) {
  double sum = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) sum += (way[i] - way[i - 1]).norm();
  return sum;
}

/// Point at `distance` along the path; clamped to its end.
Eigen::Vector2d point_at(const std::vector<Eigen::Vector2d>& way, double distance) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Eigen::Vector2d step = way[i] - way[i - 1];
    const double length = step.norm();
    if (distance <= length && length > 0.0) return way[i - 1] + step * (distance / length);
    distance -= length;
  }
  return way.back();
}

/// Whether it pauses at that time: once per period, for about the given share, at a random time.
bool pauses(const Route& route, double seconds) {
  if (route.pause_share <= 0.0 || route.pause <= 0.0) return false;
  const double period = route.pause / route.pause_share;
  const double index = std::floor(seconds / period);
  const std::uint64_t hash = hash_of(route.seed, static_cast<std::uint64_t>(index));
  const double length =
      std::min(0.9 * period, route.pause * (0.5 + static_cast<double>(uniform_of(hash))));
  const double begin = static_cast<double>(uniform_of(hash_of(hash, 1))) * (period - length);
  const double inside = seconds - index * period;
  return inside >= begin && inside < begin + length;
}

/// A driver that follows a target point moving along the path ahead of it.
class Driver {
 public:
  explicit Driver(const Route& route)
      : route_(route), way_(unrolled(route)), length_(length_of(way_)), along_(route.start) {
    knot_.position = point_at(way_, reduced(along_));
    const Eigen::Vector2d ahead = point_at(way_, reduced(along_ + 0.1)) - knot_.position;
    knot_.yaw = std::atan2(ahead.y(), ahead.x());
  }

  const MotionKnot& knot() const { return knot_; }

  void step(double seconds) {
    const Eigen::Vector2d target = point_at(way_, reduced(along_ + route_.look_ahead));
    const Eigen::Vector2d to_target = target - knot_.position;
    const bool arrived = ends() && along_ >= length_ - 1e-6;
    const double error = arrived || to_target.norm() < 1e-3
                             ? 0.0
                             : wrapped(std::atan2(to_target.y(), to_target.x()) - knot_.yaw);
    turn(error);
    accelerate(wanted_speed(error, seconds));
    const double moved = speed_ * kStep;
    knot_.position += moved * Eigen::Vector2d(std::cos(knot_.yaw), std::sin(knot_.yaw));
    knot_.travelled += moved;
    advance(moved, to_target.norm());
  }

 private:
  bool ends() const { return route_.end == RouteEnd::kStop; }

  double reduced(double along) const {
    if (ends() || length_ <= 0.0) return along;
    return along - length_ * std::floor(along / length_);
  }

  double wanted_speed(double error, double seconds) const {
    if (pauses(route_, seconds)) return 0.0;
    double speed = route_.speed * std::clamp(1.2 - std::abs(error), 0.0, 1.0);
    if (ends()) {
      const double left = std::max(0.0, length_ - along_);
      speed = std::min(speed, std::sqrt(2.0 * route_.acceleration * left));
    }
    return speed;
  }

  void turn(double error) {
    const double most = route_.turn_rate * kStep;
    knot_.yaw += std::clamp(0.25 * error, -most, most);
  }

  void accelerate(double target_speed) {
    const double most = route_.acceleration * kStep;
    speed_ += std::clamp(target_speed - speed_, -2.0 * most, most);
  }

  /// The target moves as far as the driver, and further while it is too close: after a shortcut at
  /// a corner, or where the path turns back.
  void advance(double moved, double distance) {
    const double lag = std::max(0.0, 1.0 - distance / route_.look_ahead);
    along_ += moved * (1.0 + 2.0 * lag);
    if (ends()) along_ = std::min(along_, length_);
  }

  const Route& route_;
  std::vector<Eigen::Vector2d> way_;
  double length_;
  double along_;
  double speed_ = 0.0;
  MotionKnot knot_;
};

}  // namespace

Motion drive(const Route& route, double seconds) {
  Driver driver(route);
  const int count = static_cast<int>(std::ceil(seconds / (kStep * kStepsPerKnot))) + 2;
  std::vector<MotionKnot> knots = {driver.knot()};
  for (int i = 0; i < count * kStepsPerKnot; ++i) {
    driver.step(i * kStep);
    if ((i + 1) % kStepsPerKnot == 0) knots.push_back(driver.knot());
  }
  return Motion(std::move(knots), kStep * kStepsPerKnot);
}

double length_of(const Route& route) {
  return length_of(unrolled(route));
}

}  // namespace mms
