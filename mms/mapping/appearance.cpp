#include "mms/mapping/appearance.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

constexpr std::array<double, 3> kBorders = {0.45, 0.9, 1.4};  // between the bands [m]
constexpr float kFewest = 8.0F;                               // points that have a colour
constexpr float kBrightness = 0.4F;                           // weight beside hue
const float kRange = 255.0F * std::sqrt(3.0F);

/// Light and shade change how bright a body is more than its hue.
float color_distance(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const Eigen::Vector3f difference = a - b;
  const Eigen::Vector3f brighter = Eigen::Vector3f::Constant(difference.mean());
  return (difference - (1.0F - kBrightness) * brighter).norm();
}

}  // namespace

void Appearance::add(double height, const Eigen::Vector3f& color) {
  const auto above = std::upper_bound(kBorders.begin(), kBorders.end(), height);
  Band& band = bands_[static_cast<std::size_t>(above - kBorders.begin())];
  band.points += 1.0F;
  band.color += (color - band.color) / band.points;
}

void Appearance::learn(const Appearance& seen, float gain) {
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    Band& band = bands_[i];
    const Band& now = seen.bands_[i];
    if (now.points < kFewest) continue;
    const float share = band.points < kFewest ? 1.0F : gain;
    band.color += share * (now.color - band.color);
    band.points += share * (now.points - band.points);
  }
}

std::optional<double> Appearance::difference(const Appearance& other) const {
  float sum = 0.0F;
  float weights = 0.0F;
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    const float weight = std::min(bands_[i].points, other.bands_[i].points);
    if (weight < kFewest) continue;
    sum += weight * color_distance(bands_[i].color, other.bands_[i].color);
    weights += weight;
  }
  if (weights == 0.0F) return std::nullopt;
  return static_cast<double>(sum / (weights * kRange));
}

}  // namespace mms
