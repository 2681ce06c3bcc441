#pragma once

#include <cstddef>

#include "mms/segmentation/engine/graph/graph.hpp"

namespace mms::engine {

/// More channels than this no map has (ResNet-50's C5).
inline constexpr int kMaxChannels = 2048;

/// A map in memory, height x width x channels; does not own it.
struct Tensor {
  Shape shape;
  Format format;
  std::byte* data = nullptr;

  float* floats() const { return reinterpret_cast<float*>(data); }
};

/// Some pixels in a row (row-major indices), the channels of each side by side.
struct PixelSpan {
  int first = 0;
  int count = 0;
};

void load(const Tensor& tensor, const PixelSpan& pixels, float* channels);

/// sum += factor * channels
void accumulate(const Tensor& tensor, const PixelSpan& pixels, float factor, float* sum);

/// Rounded and limited to what the format can hold.
void store(const Tensor& tensor, const PixelSpan& pixels, const float* channels);

/// The format that holds values up to `range` in magnitude with a byte.
Format byte_format(float range, bool non_negative);

/// Rounds to the nearest whole number, within the range of the stored type.
/// @param inverse_scale  stored = value * inverse_scale
void quantize(const float* values, int count, float inverse_scale, std::int8_t* stored);

}  // namespace mms::engine
