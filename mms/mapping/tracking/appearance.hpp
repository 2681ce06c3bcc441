#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace mms {

/// What tells one person from another: histograms of the colours of shoes and shins, thighs, trunk,
/// and head. Heights are those over the floor, so that a body that is partly hidden is compared by
/// what is seen of it. Histograms bear what a mean does not: points of what is behind are a few in
/// cells of their own.
class Appearance {
 public:
  /// Takes in a point.
  /// @param height  over the floor [m]
  /// @param color   R G B, 0 to 255
  void add(double height, const Eigen::Vector3f& color);

  /// Moves on towards what was seen last, band by band.
  /// @param gain  share of the new, in (0, 1]
  void learn(const Appearance& seen, float gain);

  /// Root mean square of the Hellinger distances of the histograms of the bands that both have: 0
  /// for the same colours, 1 for none in common; nothing where they have no band in common.
  std::optional<double> difference(const Appearance& other) const;

 private:
  static constexpr int kShades = 4;  // cells of brightness
  static constexpr int kHues = 8;    // cells of the share of red, and of that of green
  using Histogram = Eigen::Array<float, kShades * kHues * kHues, 1>;
  struct Band {
    Histogram counts = Histogram::Zero();
    float points = 0.0F;  // sum of the counts
  };
  std::array<Band, 4> bands_;
};

}  // namespace mms
