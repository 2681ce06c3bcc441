#pragma once

#include <cstddef>

#include "mms/segmentation/engine/graph/graph.hpp"

namespace mms::engine {

/// Largest number of channels of a map (ResNet-50's C5).
inline constexpr int kMaxChannels = 2048;

/// A map in memory, height x width x channels; not owned.
struct Tensor {
  Shape shape;
  Format format;
  std::byte* data = nullptr;

  float* floats() const { return reinterpret_cast<float*>(data); }
};

/// Consecutive pixels (row-major indices), channels last.
struct PixelSpan {
  int first = 0;
  int count = 0;
};

void load(const Tensor& tensor, const PixelSpan& pixels, float* channels);

/// sum += factor * channels
void accumulate(const Tensor& tensor, const PixelSpan& pixels, float factor, float* sum);

/// Rounds and clips to the range of the format.
void store(const Tensor& tensor, const PixelSpan& pixels, const float* channels);

/// The int8 format for values up to `range` in magnitude.
Format byte_format(float range, bool non_negative);

/// Rounds to the nearest integer, clipped to the range of the stored type.
/// @param inverse_scale  stored = value * inverse_scale
void quantize(const float* values, int count, float inverse_scale, std::int8_t* stored);

}  // namespace mms::engine
