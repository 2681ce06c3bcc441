#include "mms/simulation/sensors/color_sensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mms/core/hash_noise.hpp"
#include "mms/geometry/parallel.hpp"

namespace mms {
namespace {

constexpr std::size_t kRowsAtOnce = 16;
constexpr float kGlare =
    8.0F;  // limit of radiance, so that the lens blur of one pixel cannot saturate many

/// sRGB curve (IEC 61966-2-1) in gray levels of 255, tabulated over the square root of the light,
/// where it is almost linear: error below 0.04 gray levels without interpolation.
class SrgbTable {
 public:
  SrgbTable() {
    for (std::size_t i = 0; i < kSize; ++i) {
      const double root = static_cast<double>(i) / (kSize - 1);
      const double light = root * root;
      grey_[i] = static_cast<float>(255.0 * (light <= 0.0031308
                                                 ? 12.92 * light
                                                 : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055));
    }
  }

  /// Light in [0, 1].
  float operator()(float light) const {
    return grey_[static_cast<std::size_t>(
        static_cast<int>(std::sqrt(light) * static_cast<float>(kSize - 1) + 0.5F))];
  }

 private:
  static constexpr std::size_t kSize = 4096;
  std::array<float, kSize> grey_{};
};

/// Half of a Gaussian of sum 1, from its center outwards, without weights below 1/1000 of the
/// first.
std::vector<float> gaussian(double sigma) {
  const double reach = std::clamp(sigma, 0.0, 20.0) * std::sqrt(2.0 * std::log(1000.0));
  std::vector<double> weights{1.0};
  double sum = 1.0;
  for (int d = 1; d <= static_cast<int>(reach); ++d) {
    weights.push_back(std::exp(-0.5 * d * d / (sigma * sigma)));
    sum += 2.0 * weights.back();
  }
  std::vector<float> half;
  for (const double weight : weights) half.push_back(static_cast<float>(weight / sum));
  return half;
}

/// to += weight * from, with radiances clamped to [0, kGlare]; NaN counts as 0.
void add_row(const float* from, float weight, std::vector<float>& to, std::size_t offset) {
  float* out = to.data() + offset;
  const std::size_t count = to.size() - 2 * offset;
  for (std::size_t i = 0; i < count; ++i) {
    out[i] += weight * std::min(std::max(0.0F, from[i]), kGlare);
  }
}

/// Blurred rows of an image in sequence; one instance per thread.
class Lens {
 public:
  Lens(const Image<Eigen::Vector3f>& radiance, const std::vector<float>& weights)
      : radiance_(radiance),
        weights_(weights),
        margin_(3 * (weights.size() - 1)),
        column_(3 * static_cast<std::size_t>(radiance.width()) + 2 * margin_),
        row_(3 * static_cast<std::size_t>(radiance.width())) {}

  /// Channels of row `y`, three per pixel; valid until the next call.
  float* blurred(int y) {
    std::fill(column_.begin(), column_.end(), 0.0F);
    const int reach = static_cast<int>(weights_.size()) - 1;
    for (int d = -reach; d <= reach; ++d) {
      const int from = std::clamp(y + d, 0, radiance_.height() - 1);
      add_row(radiance_.row(from)->data(), weights_[static_cast<std::size_t>(std::abs(d))], column_,
              margin_);
    }
    extend_border();
    return blur_along_row();
  }

 private:
  void extend_border() {
    float* left = column_.data();
    float* right = column_.data() + column_.size() - margin_;
    for (std::size_t i = 0; i < margin_; ++i) left[i] = left[margin_ + i % 3];
    for (std::size_t i = 0; i < margin_; ++i) right[i] = *(right - 3 + i % 3);
  }

  float* blur_along_row() {
    const float* centre = column_.data() + margin_;
    for (std::size_t i = 0; i < row_.size(); ++i) row_[i] = weights_[0] * centre[i];
    for (std::size_t d = 1; d < weights_.size(); ++d) {
      const float weight = weights_[d];
      const float* before = centre - 3 * d;
      const float* after = centre + 3 * d;
      float* out = row_.data();
      const std::size_t count = row_.size();
      for (std::size_t i = 0; i < count; ++i) out[i] += weight * (before[i] + after[i]);
    }
    return row_.data();
  }

  const Image<Eigen::Vector3f>& radiance_;
  const std::vector<float>& weights_;
  std::size_t margin_;         // channels beyond the boundary on each side
  std::vector<float> column_;  // blurred along the columns, with margins
  std::vector<float> row_;     // blurred in both directions
};

/// Darkens row `y` towards the corners and clamps it to [0, 1].
void vignette(float* channels, int y, int width, int height, float share) {
  const float cx = 0.5F * static_cast<float>(width - 1);
  const float cy = 0.5F * static_cast<float>(height - 1);
  const float scale = share / std::max(cx * cx + cy * cy, 1.0F);
  const float dy2 = (static_cast<float>(y) - cy) * (static_cast<float>(y) - cy);
  for (int x = 0; x < width; ++x) {
    const float dx = static_cast<float>(x) - cx;
    const float gain = 1.0F - scale * (dx * dx + dy2);
    for (int c = 0; c < 3; ++c) {
      float& channel = channels[3 * x + c];
      channel = std::clamp(channel * gain, 0.0F, 1.0F);
    }
  }
}

/// Approximately normal, mean 0 and variance 1, from the low 21 bits: the sum of three uniforms.
float normal_of_21_bits(std::uint64_t bits) {
  const auto sum = static_cast<int>((bits & 127U) + ((bits >> 7) & 127U) + ((bits >> 14) & 127U));
  constexpr float kInverseSigma = 2.0F / 128.0F;  // a uniform of 128 values has variance 128^2 / 12
  return (static_cast<float>(sum) - 190.5F) * kInverseSigma;
}

/// Noisy gray levels from light in [0, 1]; `stream` and the pixel index determine the hash.
void expose_row(const float* light, const ColorSensor& sensor, std::uint64_t stream, int width,
                Rgb* out) {
  static const SrgbTable srgb;
  const auto read2 = static_cast<float>(sensor.read_noise * sensor.read_noise);
  const auto shot2 = static_cast<float>(sensor.shot_noise * sensor.shot_noise);
  const auto level = [&](float value, std::uint64_t bits) {
    const float grey =
        srgb(value) + std::sqrt(read2 + shot2 * value) * normal_of_21_bits(bits) + 0.5F;
    return static_cast<std::uint8_t>(static_cast<int>(std::clamp(grey, 0.0F, 255.0F)));
  };
  for (int x = 0; x < width; ++x) {
    const std::uint64_t hash = hash_of(stream + static_cast<std::uint64_t>(x));
    const float* pixel = light + 3 * x;
    out[x] = {level(pixel[0], hash), level(pixel[1], hash >> 21), level(pixel[2], hash >> 42)};
  }
}

}  // namespace

Image<Rgb> develop(const Image<Eigen::Vector3f>& radiance, const ColorSensor& sensor,
                   std::uint64_t key) {
  const int width = radiance.width();
  const int height = radiance.height();
  const std::vector<float> weights = gaussian(sensor.softness);
  const std::uint64_t stream = hash_of(key);
  Image<Rgb> picture(width, height);
  parallel_chunks(static_cast<std::size_t>(height), kRowsAtOnce, [&](auto begin, auto end) {
    Lens lens(radiance, weights);
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      float* light = lens.blurred(y);
      vignette(light, y, width, height, static_cast<float>(sensor.vignetting));
      const auto first = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width);
      expose_row(light, sensor, stream + first, width, picture.row(y));
    }
  });
  return picture;
}

}  // namespace mms
