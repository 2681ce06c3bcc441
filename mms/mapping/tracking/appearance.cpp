#include "mms/mapping/tracking/appearance.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

constexpr std::array<double, 3> kBorders = {0.45, 0.9, 1.4};  // between the bands [m]
constexpr float kFewest = 8.0F;                               // points that have a colour
constexpr float kDark = 30.0F;  // R + G + B below which a colour says little

/// A place between the centers of two cells, each of which gets a share.
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

/// Light and shade change how bright a body is more than the shares of red, green and blue, which
/// therefore have more cells. The shares' ranges are those of clothes and skin.
void Appearance::add(double height, const Eigen::Vector3f& color) {
  const auto above = std::upper_bound(kBorders.begin(), kBorders.end(), height);
  Band& band = bands_[static_cast<std::size_t>(above - kBorders.begin())];
  const float sum = std::max(color.sum(), kDark);
  const Between shade(color.mean() / 255.0F, kShades);
  const Between red((color.x() / sum - 0.15F) / 0.4F, kHues);
  const Between green((color.y() / sum - 0.2F) / 0.3F, kHues);
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
    if (now.points < kFewest) continue;
    const float share = band.points < kFewest ? 1.0F : gain;
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
    if (weight < kFewest) continue;
    const float common = (a.counts * b.counts).sqrt().sum() / std::sqrt(a.points * b.points);
    sum += weight * std::max(0.0F, 1.0F - common);
    weights += weight;
  }
  if (weights == 0.0F) return std::nullopt;
  return std::sqrt(static_cast<double>(sum / weights));
}

}  // namespace mms
