#include "mms/segmentation/solo/resize.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace mms {
namespace {

/// Weights of input pixels of a row (or column) for one output pixel.
struct Taps {
  int first = 0;  ///< input pixel
  std::vector<float> weights;
};

Taps taps_of(int output, double step, int input_size) {
  const double reach = std::max(1.0, step);  // half the width of the triangle [input px]
  const double centre = (output + 0.5) * step - 0.5;
  const int first = std::max(0, static_cast<int>(std::ceil(centre - reach)));
  const int last = std::min(input_size - 1, static_cast<int>(std::floor(centre + reach)));
  Taps taps{first, {}};
  float sum = 0.0F;
  for (int i = first; i <= last; ++i) {
    const double weight = std::max(0.0, 1.0 - std::abs(i - centre) / reach);
    taps.weights.push_back(static_cast<float>(weight));
    sum += taps.weights.back();
  }
  for (float& weight : taps.weights) weight /= sum;
  return taps;
}

/// Of the output pixels [begin, begin + count).
std::vector<Taps> taps_of(int begin, int count, int output_size, int input_size) {
  const double step = static_cast<double>(input_size) / output_size;
  std::vector<Taps> taps;
  for (int i = begin; i < begin + count; ++i) taps.push_back(taps_of(i, step, input_size));
  return taps;
}

/// Weighted sum of input rows, from the column `first` on: the samples of `row` but its last one.
void mix_rows(const Image<Rgb>& image, int first, const Taps& taps, std::vector<float>& row) {
  std::fill(row.begin(), row.end(), 0.0F);
  const std::size_t samples = row.size() - 1;
  for (std::size_t k = 0; k < taps.weights.size(); ++k) {
    const Rgb* pixels = image.row(taps.first + static_cast<int>(k)) + first;
    const auto* sample = reinterpret_cast<const std::uint8_t*>(pixels);
    const float weight = taps.weights[k];
    for (std::size_t i = 0; i < samples; ++i) row[i] += weight * sample[i];
  }
}

/// Weighted sum of a row's pixels, as a vector of four: it reads one sample beyond the last pixel.
/// @param first  column of the row's first pixel
Rgb mix_pixels(const std::vector<float>& row, int first, const Taps& taps) {
  Eigen::Array4f sum = Eigen::Array4f::Constant(0.5F);  // for rounding
  const float* sample = row.data() + 3 * static_cast<std::size_t>(taps.first - first);
  for (const float weight : taps.weights) {
    sum += weight * Eigen::Map<const Eigen::Array4f>(sample);
    sample += 3;
  }
  return {static_cast<std::uint8_t>(sum[0]), static_cast<std::uint8_t>(sum[1]),
          static_cast<std::uint8_t>(sum[2])};
}

}  // namespace

Image<Rgb> resize(const Image<Rgb>& image, int width, int height) {
  if (image.width() == width && image.height() == height) return image;
  return resize_part(image, width, height, {0, 0, width, height});
}

Image<Rgb> resize_part(const Image<Rgb>& image, int width, int height, const Window& window) {
  Image<Rgb> result(window.width, window.height);
  if (result.empty()) return result;
  const std::vector<Taps> columns = taps_of(window.x, window.width, width, image.width());
  const std::vector<Taps> rows = taps_of(window.y, window.height, height, image.height());
  const int first = columns.front().first;
  const int end = columns.back().first + static_cast<int>(columns.back().weights.size());
  std::vector<float> mixed(3 * static_cast<std::size_t>(end - first) + 1);  // see mix_pixels
  for (int y = 0; y < window.height; ++y) {
    mix_rows(image, first, rows[static_cast<std::size_t>(y)], mixed);
    for (int x = 0; x < window.width; ++x) {
      result(x, y) = mix_pixels(mixed, first, columns[static_cast<std::size_t>(x)]);
    }
  }
  return result;
}

double fitting_scale(int width, int height, int long_side, int short_side) {
  return std::min(static_cast<double>(long_side) / std::max(width, height),
                  static_cast<double>(short_side) / std::min(width, height));
}

int scaled_length(int length, double scale) {
  return std::max(1, static_cast<int>(std::lround(length * scale)));
}

}  // namespace mms
