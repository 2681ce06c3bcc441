#include "mms/segmentation/engine/map_operations.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mms::engine {
namespace {

constexpr double kGroupNormFloor = 1e-5;  // added to the variance

using Channels = std::array<float, kMaxChannels>;

/// Numbers of several pixels between loading and storing: small enough for the L1 cache.
using Strip = std::array<float, 2 * kMaxChannels>;

int strip_pixels(const Shape& shape) {
  return std::max(1, static_cast<int>(std::tuple_size_v<Strip>) / shape.channels);
}

/// Calls function(pixels, strip) for all pixels of a shape, in parallel.
template <typename Function>
void for_strips(const Shape& shape, const Function& function) {
  const int length = strip_pixels(shape);
  const int pixels = shape.pixels();
#pragma omp parallel for schedule(static)
  for (int first = 0; first < pixels; first += length) {
    Strip strip;
    function(PixelSpan{first, std::min(length, pixels - first)}, strip.data());
  }
}

/// values = scale values + shift, per channel.
void transform(int pixels, int channels, const float* scale, const float* shift, float* values) {
  for (int pixel = 0; pixel < pixels; ++pixel, values += channels) {
    for (int c = 0; c < channels; ++c) values[c] = values[c] * scale[c] + shift[c];
  }
}

void limit_below(float* values, int count) {
  for (int i = 0; i < count; ++i) values[i] = std::max(values[i], 0.0F);
}

/// The mean over all pixels, per channel.
void mean_of(const Tensor& tensor, float* mean) {
  const int count = tensor.shape.channels;
  std::fill_n(mean, count, 0.0F);
  const float share = 1.0F / static_cast<float>(tensor.shape.pixels());
  for (int pixel = 0; pixel < tensor.shape.pixels(); ++pixel) {
    accumulate(tensor, {pixel, 1}, share, mean);
  }
}

float dot(const float* a, const float* b, int count) {
  constexpr int kLanes = 8;  // parallel sums, which fit a vector register
  std::array<float, kLanes> sums{};
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      sums[static_cast<std::size_t>(lane)] += a[i + lane] * b[i + lane];
    }
  }
  float sum = 0.0F;
  for (const float part : sums) sum += part;
  for (; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

/// W x + b of a 1x1 layer.
void apply(const ConvLayer& layer, const float* x, float* y) {
  for (int o = 0; o < layer.out; ++o) {
    y[o] = layer.bias[static_cast<std::size_t>(o)] +
           dot(layer.weight.data() + std::ptrdiff_t{o} * layer.in, x, layer.in);
  }
}

int mirrored(int i, int count) {
  const int inside = i < 0 ? -i : i;
  return std::clamp(inside < count ? inside : 2 * (count - 1) - inside, 0, count - 1);
}

float box_mean(const std::vector<float>& map, const Shape& shape, int y, int x, int box) {
  const int half = box / 2;
  float sum = 0.0F;
  for (int dy = -half; dy <= half; ++dy) {
    const int row = mirrored(y + dy, shape.height) * shape.width;
    for (int dx = -half; dx <= half; ++dx) {
      sum += map[static_cast<std::size_t>(row + mirrored(x + dx, shape.width))];
    }
  }
  return sum / static_cast<float>(box * box);
}

/// Scale and shift per channel of a group norm on a map.
void group_transform(const GroupNorm& norm, const Tensor& x, float* scale, float* shift) {
  const int size = x.shape.channels / norm.groups;
  std::array<double, kMaxChannels> sums{};
  std::array<double, kMaxChannels> squares{};
  Channels channels;
  for (int pixel = 0; pixel < x.shape.pixels(); ++pixel) {
    load(x, {pixel, 1}, channels.data());
    for (int c = 0; c < x.shape.channels; ++c) {
      const auto value = static_cast<double>(channels[static_cast<std::size_t>(c)]);
      sums[static_cast<std::size_t>(c / size)] += value;
      squares[static_cast<std::size_t>(c / size)] += value * value;
    }
  }
  const double count = static_cast<double>(size) * x.shape.pixels();
  for (int c = 0; c < x.shape.channels; ++c) {
    const auto group = static_cast<std::size_t>(c / size);
    const double mean = sums[group] / count;
    const double variance = std::max(0.0, squares[group] / count - mean * mean);
    const auto gamma = static_cast<double>(norm.gamma[static_cast<std::size_t>(c)]);
    scale[c] = static_cast<float>(gamma / std::sqrt(variance + kGroupNormFloor));
    shift[c] = norm.beta[static_cast<std::size_t>(c)] - static_cast<float>(mean) * scale[c];
  }
}

}  // namespace

Resizer::Neighbours Resizer::bilinear(int i, int from, int to) {
  const float centre =
      (static_cast<float>(i) + 0.5F) * static_cast<float>(from) / static_cast<float>(to) - 0.5F;
  const float at = std::max(centre, 0.0F);
  const int first = std::min(static_cast<int>(at), from - 1);
  return {first, std::min(first + 1, from - 1), at - static_cast<float>(first)};
}

Resizer::Neighbours Resizer::nearest(int i, int from, int to) {
  const int first = std::min(i * from / to, from - 1);
  return {first, first, 0.0F};
}

Resizer::Resizer(const Resizing& resizing, const Shape& from, const Shape& to) {
  const auto at = resizing.bilinear ? bilinear : nearest;
  for (int y = 0; y < to.height; ++y) rows_.push_back(at(y, from.height, to.height));
  for (int x = 0; x < to.width; ++x) columns_.push_back(at(x, from.width, to.width));
}

void Resizer::run(const Tensor& x, const Tensor* addend, const Tensor& y) const {
  for_strips(y.shape, [&](const PixelSpan& pixels, float* strip) {
    if (addend != nullptr) {
      load(*addend, pixels, strip);
    } else {
      std::fill_n(strip, pixels.count * y.shape.channels, 0.0F);
    }
    float* sum = strip;
    for (int i = 0; i < pixels.count; ++i, sum += y.shape.channels) {
      const int pixel = pixels.first + i;
      const Neighbours& v = rows_[static_cast<std::size_t>(pixel / y.shape.width)];
      const Neighbours& h = columns_[static_cast<std::size_t>(pixel % y.shape.width)];
      const auto add = [&](int row, int column, float share) {
        if (share != 0.0F) accumulate(x, {row * x.shape.width + column, 1}, share, sum);
      };
      add(v.first, h.first, (1.0F - v.share) * (1.0F - h.share));
      add(v.first, h.second, (1.0F - v.share) * h.share);
      add(v.second, h.first, v.share * (1.0F - h.share));
      add(v.second, h.second, v.share * h.share);
    }
    store(y, pixels, strip);
  });
}

void concatenate(const std::vector<Tensor>& parts, const Tensor& y) {
  for_strips(y.shape, [&](const PixelSpan& pixels, float* strip) {
    float* next = strip;
    for (int i = 0; i < pixels.count; ++i) {
      for (const Tensor& part : parts) {
        load(part, {pixels.first + i, 1}, next);
        next += part.shape.channels;
      }
    }
    store(y, pixels, strip);
  });
}

void add_global_context(const GlobalContext& context, const Tensor& x, const Tensor* residual,
                        const Tensor& y) {
  const int channels = x.shape.channels;
  Channels mean;
  Channels shift;
  mean_of(x, mean.data());
  apply(*context.layer, mean.data(), shift.data());
  transform(1, channels, context.scale.data(), context.shift.data(), shift.data());
  for_strips(y.shape, [&](const PixelSpan& pixels, float* strip) {
    load(x, pixels, strip);
    transform(pixels.count, channels, context.scale.data(), shift.data(), strip);
    if (residual != nullptr) accumulate(*residual, pixels, 1.0F, strip);
    if (context.relu) limit_below(strip, pixels.count * channels);
    store(y, pixels, strip);
  });
}

void compute_gate(const Gate& gate, const Tensor& x, std::vector<float>& scratch, const Tensor& y) {
  const int channels = x.shape.channels;
  for_strips(x.shape, [&](const PixelSpan& pixels, float* strip) {
    load(x, pixels, strip);
    for (int i = 0; i < pixels.count; ++i, strip += channels) {
      scratch[static_cast<std::size_t>(pixels.first + i)] =
          gate.bias + dot(gate.weight.data(), strip, channels);
    }
  });
  for_strips(y.shape, [&](const PixelSpan& pixels, float* strip) {
    for (int i = 0; i < pixels.count; ++i) {
      const int row = (pixels.first + i) / y.shape.width * gate.stride;
      const int column = (pixels.first + i) % y.shape.width * gate.stride;
      const float value = box_mean(scratch, x.shape, row, column, gate.box);
      strip[i] = gate.sigmoid ? 1.0F / (1.0F + std::exp(-value)) : value;
    }
    store(y, pixels, strip);
  });
}

void blend(const Tensor& a, const Tensor& b, const Tensor& gate, const Tensor& y) {
  for_strips(y.shape, [&](const PixelSpan& pixels, float* strip) {
    std::fill_n(strip, pixels.count * y.shape.channels, 0.0F);
    float* sum = strip;
    for (int i = 0; i < pixels.count; ++i, sum += y.shape.channels) {
      const PixelSpan pixel = {pixels.first + i, 1};
      const float share = gate.floats()[pixel.first];
      accumulate(a, pixel, share, sum);
      accumulate(b, pixel, 1.0F - share, sum);
    }
    store(y, pixels, strip);
  });
}

void compute_global_branch(const GlobalBranch& branch, const Tensor& x, const Tensor& y) {
  const int channels = y.shape.channels;
  Channels mean;
  Channels values;
  mean_of(x, mean.data());
  apply(*branch.layer, mean.data(), values.data());
  limit_below(values.data(), channels);
  for_strips(y.shape, [&](const PixelSpan& pixels, float* strip) {
    for (int i = 0; i < pixels.count; ++i) {
      std::copy_n(values.data(), channels, strip + std::ptrdiff_t{i} * channels);
    }
    store(y, pixels, strip);
  });
}

void normalise_groups(const GroupNorm& norm, const Tensor& x, const Tensor& y) {
  Channels scale;
  Channels shift;
  group_transform(norm, x, scale.data(), shift.data());
  for_strips(y.shape, [&](const PixelSpan& pixels, float* strip) {
    load(x, pixels, strip);
    transform(pixels.count, x.shape.channels, scale.data(), shift.data(), strip);
    limit_below(strip, pixels.count * x.shape.channels);
    store(y, pixels, strip);
  });
}

void convert(const Tensor& x, const Tensor& y) {
  for_strips(y.shape, [&](const PixelSpan& pixels, float* strip) {
    load(x, pixels, strip);
    store(y, pixels, strip);
  });
}

}  // namespace mms::engine
