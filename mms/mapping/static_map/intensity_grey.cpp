#include "mms/mapping/static_map/intensity_grey.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

constexpr float kDarkest = 55.0F;  ///< [-]: grey of intensity 0. Source: seen on a dark background.
constexpr float kSpan = 255.0F - kDarkest;  ///< [-]: greys of all intensities. Source: 8 bits.

bool is_grey(const Rgb& color) {
  return color.r == color.g && color.g == color.b && static_cast<float>(color.r) >= kDarkest;
}

}  // namespace

Rgb grey_of(std::uint8_t intensity) {
  const float share = std::sqrt(static_cast<float>(intensity) / 255.0F);
  const auto grey = static_cast<std::uint8_t>(std::lround(kDarkest + kSpan * share));
  return {grey, grey, grey};
}

std::vector<float> intensities_of(const std::vector<Rgb>& greys) {
  const auto none = [](const Rgb& color) { return color == kNoColor; };
  if (!std::all_of(greys.begin(), greys.end(), is_grey)) return {};
  if (std::all_of(greys.begin(), greys.end(), none)) return {};
  std::vector<float> intensities;
  intensities.reserve(greys.size());
  for (const Rgb& color : greys) {
    const float share = (static_cast<float>(color.r) - kDarkest) / kSpan;
    intensities.push_back(share * share);
  }
  return intensities;
}

}  // namespace mms
