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

std::vector<Taps> all_taps(int output_size, int input_size) {
  const double step = static_cast<double>(input_size) / output_size;
  std::vector<Taps> taps;
  for (int i = 0; i < output_size; ++i) taps.push_back(taps_of(i, step, input_size));
  return taps;
}

/// Weighted sum of input rows: 3 * width samples, and the rest of `row`.
void mix_rows(const Image<Rgb>& image, const Taps& taps, std::vector<float>& row) {
  const std::size_t samples = 3 * static_cast<std::size_t>(image.width());
  std::fill(row.begin(), row.end(), 0.0F);
  for (std::size_t k = 0; k < taps.weights.size(); ++k) {
    const Rgb* pixels = image.row(taps.first + static_cast<int>(k));
    const auto* sample = reinterpret_cast<const std::uint8_t*>(pixels);
    const float weight = taps.weights[k];
    for (std::size_t i = 0; i < samples; ++i) row[i] += weight * sample[i];
  }
}

/// Weighted sum of a row's pixels, as a vector of four: it reads one sample beyond the last pixel.
Rgb mix_pixels(const std::vector<float>& row, const Taps& taps) {
  Eigen::Array4f sum = Eigen::Array4f::Constant(0.5F);  // for rounding
  const float* sample = row.data() + 3 * static_cast<std::size_t>(taps.first);
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
  const std::vector<Taps> columns = all_taps(width, image.width());
  const std::vector<Taps> rows = all_taps(height, image.height());
  std::vector<float> mixed(3 * static_cast<std::size_t>(image.width()) + 1);  // see mix_pixels
  Image<Rgb> result(width, height);
  for (int y = 0; y < height; ++y) {
    mix_rows(image, rows[static_cast<std::size_t>(y)], mixed);
    for (int x = 0; x < width; ++x) {
      result(x, y) = mix_pixels(mixed, columns[static_cast<std::size_t>(x)]);
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
