#include "mms/mapping/tracking/appearance.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

/// [m]: heights between the bands. Source: knee, hip and shoulder of a person of 1.7 m (0.285,
/// 0.530 and 0.818 of the stature; Drillis and Contini, 1966).
constexpr std::array<double, 3> kBandLimits = {0.45, 0.9, 1.4};

/// [-]: points from which a band has a histogram. Source: 2 % of a measurement's 400 points, the
/// share that may be stray.
constexpr float kMinPoints = 8.0F;

/// [-]: least R + G + B by which shares of colours are divided. Source: noise of three levels of
/// 255 changes a share of it by 0.1, two cells.
constexpr float kMinBrightness = 30.0F;

/// Range of a color's share of R + G + B that the cells cover.
struct ShareRange {
  float min;
  float width;

  float place_of(float share) const { return (share - min) / width; }
};

/// [-]: range of red. Source: clothes and skin; measured on the simulated scenes.
constexpr ShareRange kRedRange{0.15F, 0.4F};

/// [-]: range of green. Source: that of red.
constexpr ShareRange kGreenRange{0.2F, 0.3F};

/// A position between the centers of two cells, each of which gets a share.
struct Between {
  int low;
  int high;
  float share_high;

  /// @param value  in [0, 1] of all cells
  Between(float value, int cells) {
    const float last = static_cast<float>(cells - 1);
    const float place = std::clamp(value * static_cast<float>(cells) - 0.5F, 0.0F, last);
    low = static_cast<int>(place);
    high = std::min(low + 1, cells - 1);
    share_high = place - static_cast<float>(low);
  }

  int cell(bool is_high) const { return is_high ? high : low; }
  float share(bool is_high) const { return is_high ? share_high : 1.0F - share_high; }
};

}  // namespace

/// Light and shade change the brightness of a body more than its shares of red, green and blue,
/// which therefore have more cells.
void Appearance::add(double height, const Eigen::Vector3f& color) {
  const auto above = std::upper_bound(kBandLimits.begin(), kBandLimits.end(), height);
  Band& band = bands_[static_cast<std::size_t>(above - kBandLimits.begin())];
  const float sum = std::max(color.sum(), kMinBrightness);
  const Between shade(color.mean() / 255.0F, kShades);
  const Between red(kRedRange.place_of(color.x() / sum), kHues);
  const Between green(kGreenRange.place_of(color.y() / sum), kHues);
  for (const bool s : {false, true}) {
    for (const bool r : {false, true}) {
      for (const bool g : {false, true}) {
        const int cell = (shade.cell(s) * kHues + red.cell(r)) * kHues + green.cell(g);
        band.counts[cell] += shade.share(s) * red.share(r) * green.share(g);
      }
    }
  }
  band.points += 1.0F;
}

void Appearance::learn(const Appearance& seen, float gain) {
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    Band& band = bands_[i];
    const Band& now = seen.bands_[i];
    if (now.points < kMinPoints) continue;
    const float share = band.points < kMinPoints ? 1.0F : gain;
    band.counts += share * (now.counts - band.counts);
    band.points += share * (now.points - band.points);
  }
}

std::optional<double> Appearance::difference(const Appearance& other) const {
  float sum = 0.0F;
  float weights = 0.0F;
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    const Band& a = bands_[i];
    const Band& b = other.bands_[i];
    const float weight = std::min(a.points, b.points);
    if (weight < kMinPoints) continue;
    const float common = (a.counts * b.counts).sqrt().sum() / std::sqrt(a.points * b.points);
    sum += weight * std::max(0.0F, 1.0F - common);
    weights += weight;
  }
  if (weights == 0.0F) return std::nullopt;
  return std::sqrt(static_cast<double>(sum / weights));
}

}  // namespace mms
