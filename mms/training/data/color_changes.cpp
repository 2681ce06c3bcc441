#include <algorithm>
#include <array>
#include <cmath>

#include "mms/training/data/augmentation.hpp"

namespace mms {
namespace {

/// A linear change of color: out = matrix * in + offset, per channel r, g, b.
struct ColorChange {
  std::array<std::array<float, 3>, 3> matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  float offset = 0.0F;
};

constexpr std::array<float, 3> kLuma = {0.299F, 0.587F, 0.114F};

/// Mixes every color with its gray value; 0 removes all color.
ColorChange saturated(float saturation) {
  ColorChange change;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      change.matrix[i][j] = (1.0F - saturation) * kLuma[j] + (i == j ? saturation : 0.0F);
    }
  }
  return change;
}

/// Random light: exposure, contrast around mid-gray, saturation, and a tint of each channel.
ColorChange random_light(RandomStream& random) {
  ColorChange change = saturated(random.between(0.4F, 1.6F));
  const float contrast = random.between(0.6F, 1.4F);
  const float gain = random.between(0.6F, 1.4F);
  for (auto& row : change.matrix) {
    const float tint = random.between(0.9F, 1.1F);
    for (float& entry : row) entry *= gain * contrast * tint;
  }
  change.offset = 128.0F * (1.0F - contrast) + random.between(-20.0F, 20.0F);
  return change;
}

std::uint8_t sample_of(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
}

void apply(const ColorChange& change, Image<Rgb>& image) {
  for (Rgb& pixel : image.pixels()) {
    const std::array<float, 3> in = {static_cast<float>(pixel.r), static_cast<float>(pixel.g),
                                     static_cast<float>(pixel.b)};
    const auto mixed = [&](std::size_t i) {
      const auto& row = change.matrix[i];
      return sample_of(row[0] * in[0] + row[1] * in[1] + row[2] * in[2] + change.offset);
    };
    pixel = {mixed(0), mixed(1), mixed(2)};
  }
}

/// Dark, or overexposed with the brightest parts cut off.
ColorChange random_exposure(RandomStream& random) {
  ColorChange change;
  const float gain = random.chance(0.6F) ? random.between(0.1F, 0.5F) : random.between(1.6F, 3.0F);
  for (std::size_t i = 0; i < 3; ++i) change.matrix[i][i] = gain;
  return change;
}

/// The image with its first and last columns repeated.
Image<Rgb> widened(const Image<Rgb>& image, int by) {
  Image<Rgb> result(image.width() + 2 * by, image.height());
  for (int y = 0; y < image.height(); ++y) {
    Rgb* row = result.row(y);
    std::fill_n(row, by, image(0, y));
    std::copy_n(image.row(y), image.width(), row + by);
    std::fill_n(row + by + image.width(), by, image(image.width() - 1, y));
  }
  return result;
}

/// Mean along a line through every pixel.
void blur_along(float angle, int length, Image<Rgb>& image) {
  const int reach = length / 2 + 1;
  const Image<Rgb> source = widened(image, reach);
  std::vector<std::pair<int, int>> steps;
  for (int i = 0; i < length; ++i) {
    const float along = static_cast<float>(i) - 0.5F * static_cast<float>(length - 1);
    steps.emplace_back(std::lround(along * std::cos(angle)), std::lround(along * std::sin(angle)));
  }
  const std::size_t samples = 3 * static_cast<std::size_t>(image.width());
  const float share = 1.0F / static_cast<float>(length);
  std::vector<float> sum(samples);
  for (int y = 0; y < image.height(); ++y) {
    std::fill(sum.begin(), sum.end(), 0.5F);  // for rounding
    for (const auto& [dx, dy] : steps) {      // whole rows, which the compiler vectorizes
      const Rgb* row = source.row(std::clamp(y + dy, 0, image.height() - 1)) + reach + dx;
      const auto* sample = reinterpret_cast<const std::uint8_t*>(row);
      for (std::size_t i = 0; i < samples; ++i) sum[i] += share * static_cast<float>(sample[i]);
    }
    auto* blurred = reinterpret_cast<std::uint8_t*>(image.row(y));
    for (std::size_t i = 0; i < samples; ++i) blurred[i] = static_cast<std::uint8_t>(sum[i]);
  }
}

/// Triangular noise on every sample: the sum of two uniform values.
void add_noise(float spread, Image<Rgb>& image, RandomStream& random) {
  const auto noisy = [&](std::uint8_t value, std::uint32_t bits) {
    const float sum = static_cast<float>(bits & 0x3FFU) + static_cast<float>((bits >> 10) & 0x3FFU);
    return sample_of(static_cast<float>(value) + spread * (sum / 1023.0F - 1.0F));
  };
  for (Rgb& pixel : image.pixels()) {
    const std::uint64_t bits = random.bits();
    pixel = {noisy(pixel.r, static_cast<std::uint32_t>(bits)),
             noisy(pixel.g, static_cast<std::uint32_t>(bits >> 20)),
             noisy(pixel.b, static_cast<std::uint32_t>(bits >> 40))};
  }
}

}  // namespace

void change_colors(Sample& sample, const AugmentationConfig& config, RandomStream& random) {
  constexpr float kPi = 3.14159265F;
  constexpr float kMaxNoise = 30.0F;
  const auto chance = [&](double p) { return random.chance(static_cast<float>(p)); };
  if (chance(config.color)) apply(random_light(random), sample.image);
  if (config.exposure > 0.0 && chance(config.exposure)) {
    apply(random_exposure(random), sample.image);
  }
  if (chance(config.grey)) apply(saturated(0.0F), sample.image);
  if (chance(config.blur)) {
    const float length = random.between(2.0F, static_cast<float>(config.blur_length) + 1.0F);
    blur_along(random.between(0.0F, kPi), static_cast<int>(length), sample.image);
  }
  if (chance(config.noise)) add_noise(random.between(0.0F, kMaxNoise), sample.image, random);
}

}  // namespace mms
