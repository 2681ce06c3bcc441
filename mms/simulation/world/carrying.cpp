#include "mms/simulation/world/carrying.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "mms/core/random_stream.hpp"

namespace mms {
namespace {

constexpr double kInterval = 0.2;     // between knots [s]
constexpr double kMargin = 0.4;       // reach of a knot [s]
constexpr double kFirst = 3.0;        // earliest place on the way [s]
constexpr double kLast = 4.0;         // latest place on the way, before the first dark time [s]
constexpr float kMaxDistance = 0.3F;  // from the way, in x and y [m]

double period(const SceneConfig& config) {
  return config.dark_for + config.light_for;
}

/// Index of the last dark time that has begun, or -1.
int dark_time(const SceneConfig& config, double seconds) {
  if (seconds < config.dark_from) return -1;
  if (config.light_for <= 0.0) return 0;
  return static_cast<int>((seconds - config.dark_from) / period(config));
}

double begin_of(const SceneConfig& config, int dark_time) {
  return config.dark_from + dark_time * period(config);
}

/// A stretch of the way that is driven again.
struct Stretch {
  double later = 0.0;  ///< than before [s]
  Eigen::Vector2d offset{0.0, 0.0};
};

/// The stretch after a dark time.
Stretch stretch_after(const SceneConfig& config, int dark_time) {
  RandomStream random(hash_of(daily_seed(config, 0xca44), static_cast<std::uint64_t>(dark_time)));
  const double last = std::max(kFirst, config.dark_from - kLast);
  const double place = kFirst + (last - kFirst) * static_cast<double>(random.uniform());
  const auto offset = [&] {
    return static_cast<double>(random.between(-kMaxDistance, kMaxDistance));
  };
  const double x = offset();
  return {begin_of(config, dark_time) + config.dark_for - place, {x, offset()}};
}

MotionKnot knot_at(const Motion& way, const Stretch& stretch, const Companion& companion,
                   double seconds) {
  const double at = seconds - stretch.later + companion.ahead;
  const double yaw = way.yaw(at);
  const Eigen::Vector2d left(-std::sin(yaw), std::cos(yaw));
  return {way.position(at) + companion.aside * left + stretch.offset, yaw, way.travelled(at)};
}

double nearest_turn(double yaw, double to) {
  return to + std::remainder(yaw - to, 2.0 * std::numbers::pi);
}

MotionKnot between(const MotionKnot& a, const MotionKnot& b, double share) {
  return {a.position + share * (b.position - a.position),
          a.yaw + share * (nearest_turn(b.yaw, a.yaw) - a.yaw),
          a.travelled + share * (b.travelled - a.travelled)};
}

/// @param first  the stretch until it is first carried
Motion walk(const SceneConfig& config, const Motion& way, double seconds, const Stretch& first,
            const Companion& companion) {
  const double length = std::max(kInterval, config.dark_for - 2.0 * kMargin);
  std::vector<MotionKnot> knots;
  for (double t = 0.0; t < seconds + kMargin; t = kInterval * static_cast<double>(knots.size())) {
    const int dark = config.carried ? dark_time(config, t) : -1;
    MotionKnot knot =
        knot_at(way, dark < 1 ? first : stretch_after(config, dark - 1), companion, t);
    if (dark >= 0) {
      const double u = std::clamp((t - begin_of(config, dark) - kMargin) / length, 0.0, 1.0);
      const MotionKnot next = knot_at(way, stretch_after(config, dark), companion, t);
      knot = between(knot, next, u * u * (3.0 - 2.0 * u));
    }
    if (!knots.empty()) knot.yaw = nearest_turn(knot.yaw, knots.back().yaw);
    knots.push_back(knot);
  }
  return Motion(std::move(knots), kInterval);
}

}  // namespace

bool is_dark(const SceneConfig& config, double seconds) {
  const int dark = dark_time(config, seconds);
  return dark >= 0 && seconds < begin_of(config, dark) + config.dark_for;
}

Motion carried(const SceneConfig& config, const Motion& way, double seconds) {
  return walk(config, way, seconds, {}, {});
}

Motion accompany(const SceneConfig& config, const Motion& way, double seconds,
                 const Companion& companion) {
  const double ahead = config.carried ? 0.5 * config.dark_from : 0.0;
  return walk(config, way, seconds, {-ahead, {0.0, 0.0}}, companion);
}

}  // namespace mms
