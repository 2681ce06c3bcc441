#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mms/simulation/world/motion.hpp"

namespace mms {

/// Behavior at the end of a route.
enum class RouteEnd : std::uint8_t {
  kStop,      ///< stops
  kLoop,      ///< continues at the first corner
  kToAndFro,  ///< turns around and goes back
};

/// A path on the floor along straight lines with rounded corners.
struct Route {
  std::vector<Eigen::Vector2d> corners;  ///< at least one [m]
  RouteEnd end = RouteEnd::kStop;
  double speed = 1.0;         ///< [m/s]
  double acceleration = 0.8;  ///< [m/s^2]
  double turn_rate = 1.2;     ///< [rad/s]
  double look_ahead = 0.6;    ///< shortcut distance at corners [m]
  double start = 0.0;         ///< position along the route at time 0 [m]
  double pause_share = 0.0;   ///< share of time that it pauses
  double pause = 3.0;         ///< mean length of a pause [s]
  std::uint64_t seed = 0;     ///< of the pauses
};

/// Drives the route from time 0 for `seconds`: accelerates, slows down for turns, pauses.
Motion drive(const Route& route, double seconds);

/// Length of the route's lines, once [m].
double length_of(const Route& route);

}  // namespace mms
