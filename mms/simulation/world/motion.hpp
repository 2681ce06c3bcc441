#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

namespace mms {

/// State of an object moving on the floor.
struct MotionKnot {
  Eigen::Vector2d position{0.0, 0.0};  ///< [m]
  double yaw = 0.0;                    ///< [rad], not wrapped
  double travelled = 0.0;              ///< path length since time 0 [m]
};

/// A planar trajectory as a function of time: uniform cubic B-splines through the knots' values, so
/// that position, heading and their derivatives are smooth and exact at any time. Static before the
/// first and after the last knot.
class Motion {
 public:
  /// @param knots    at least one, at the times 0, interval, 2 interval, ...
  /// @param interval [s]
  Motion(std::vector<MotionKnot> knots, double interval);

  /// A static pose.
  static Motion still(const Eigen::Vector2d& position, double yaw);

  Eigen::Vector2d position(double seconds) const;
  Eigen::Vector2d velocity(double seconds) const;  ///< derivative of `position` [m/s]
  double yaw(double seconds) const;
  double travelled(double seconds) const;

  /// Origin on the floor, x forward, z up.
  Eigen::Isometry3d T_world_object(double seconds) const;

 private:
  using Weights = std::array<double, 4>;
  struct Place {
    std::size_t first;  ///< index of the first of four relevant knots; may lie beyond the ends
    double u;           ///< in [0, 1]
  };
  Place place(double seconds) const;
  const MotionKnot& knot(std::size_t index) const;
  template <class Value, class Get>
  Value blend(std::size_t first, const Weights& weights, const Value& zero, const Get& get) const;

  std::vector<MotionKnot> knots_;
  double interval_;
};

}  // namespace mms
