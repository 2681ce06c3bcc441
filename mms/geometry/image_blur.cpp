#include "mms/geometry/image_blur.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mms {
namespace {

/// [px]: half width of the second blur. Source: Crété et al., a mean of nine pixels.
constexpr int kBlurReach = 4;

/// [px]: spacing of the rows and columns that are read. Source: computing time.
constexpr int kLineSpacing = 4;

/// Differences between the neighbors of a line, and how much the second blur takes from them.
struct Differences {
  double all = 0.0;
  double taken = 0.0;

  void add(const std::vector<float>& line) {
    constexpr float kTaps = 2 * kBlurReach + 1;
    for (std::size_t i = kBlurReach + 1; i + kBlurReach < line.size(); ++i) {
      const float sharp = std::abs(line[i] - line[i - 1]);
      const float blurred = std::abs(line[i + kBlurReach] - line[i - kBlurReach - 1]) / kTaps;
      all += sharp;
      taken += std::max(0.0F, sharp - blurred);
    }
  }
  double blur() const { return all > 0.0 ? 1.0 - taken / all : 0.0; }
};

/// The green channel stands for the brightness.
float brightness(const Rgb& color) {
  return static_cast<float>(color.g);
}

}  // namespace

double image_blur(const std::vector<Rgb>& colors, int width, int height) {
  const auto at = [&](int x, int y) {
    return brightness(colors[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x)]);
  };
  Differences along_rows;
  std::vector<float> line(static_cast<std::size_t>(width));
  for (int y = 0; y < height; y += kLineSpacing) {
    for (int x = 0; x < width; ++x) line[static_cast<std::size_t>(x)] = at(x, y);
    along_rows.add(line);
  }
  Differences along_columns;
  line.resize(static_cast<std::size_t>(height));
  for (int x = 0; x < width; x += kLineSpacing) {
    for (int y = 0; y < height; ++y) line[static_cast<std::size_t>(y)] = at(x, y);
    along_columns.add(line);
  }
  return std::max(along_rows.blur(), along_columns.blur());
}

}  // namespace mms
