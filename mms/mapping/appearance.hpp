#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace mms {

/// What tells one person from another: the mean colours of shoes and shins, thighs, trunk, and
/// head. Heights are those over the floor, so that a body that is partly hidden is compared by what
/// is seen of it.
class Appearance {
 public:
  /// Takes in a point.
  /// @param height  over the floor [m]
  /// @param color   R G B, 0 to 255
  void add(double height, const Eigen::Vector3f& color);

  /// Moves on towards what was seen last, band by band.
  /// @param gain  share of the new, in (0, 1]
  void learn(const Appearance& seen, float gain);

  /// Mean distance of the colours of the bands that both have, in [0, 1] of the way from black to
  /// white; nothing where they have none in common.
  std::optional<double> difference(const Appearance& other) const;

 private:
  struct Band {
    Eigen::Vector3f color = Eigen::Vector3f::Zero();
    float points = 0.0F;
  };
  std::array<Band, 4> bands_;
};

}  // namespace mms
