#pragma once

#include "mms/core/config_visitor.hpp"

namespace mms {

/// Standard deviation of a depth camera's depth [m]: sigma(z) = base + quadratic * (z - 0.4 m)^2.
/// Defaults for structured light (Kinect, Xtion) from Nguyen et al. (3DIMPVT 2012); for
/// time-of-flight cameras the quadratic part is almost zero.
struct DepthNoise {
  double base = 0.0012;       ///< [m]
  double quadratic = 0.0019;  ///< [1/m]

  double sigma(double z) const {
    const double beyond = z > kNearest ? z - kNearest : 0.0;
    return base + quadratic * beyond * beyond;
  }
  float sigma(float z) const { return static_cast<float>(sigma(static_cast<double>(z))); }

  void visit(ConfigVisitor& v) {
    v.number({"base", "m", "depth noise at 0.4 m"}, base, {1e-5, 0.2});
    v.number({"quadratic", "1/m", "growth of the depth noise with (z - 0.4 m)^2"}, quadratic,
             {0.0, 0.1});
  }

 private:
  static constexpr double kNearest = 0.4;
};

}  // namespace mms
