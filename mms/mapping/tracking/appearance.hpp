#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace mms {

/// Appearance of a person: color histograms of shins, thighs, torso and head. The bands are heights
/// over the floor, so that a partly hidden body is compared by its visible parts. Histograms are
/// robust, unlike a mean: stray points of the background fall into a few cells of their own.
class Appearance {
 public:
  /// Adds a point.
  /// @param height  over the floor [m]
  /// @param color   R G B, 0 to 255
  void add(double height, const Eigen::Vector3f& color);

  /// Blends in the latest view, band by band.
  /// @param gain  share of the new view, in (0, 1]
  void learn(const Appearance& seen, float gain);

  /// Root mean square of the Hellinger distances of the histograms of the bands that both have: 0
  /// for the same colours, 1 for none in common; nothing where they have no band in common.
  std::optional<double> difference(const Appearance& other) const;

 private:
  /// [-]: cells of brightness. Source: fewer than of shares, since light and shade change it.
  static constexpr int kShades = 4;
  /// [-]: cells of the share of red, and of that of green. Source: by experiment on simulated
  /// people.
  static constexpr int kHues = 8;
  using Histogram = Eigen::Array<float, kShades * kHues * kHues, 1>;
  struct Band {
    Histogram counts = Histogram::Zero();
    float points = 0.0F;  // sum of the counts
  };
  std::array<Band, 4> bands_;
};

}  // namespace mms
