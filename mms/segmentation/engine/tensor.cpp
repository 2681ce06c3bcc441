#include "mms/segmentation/engine/tensor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace mms::engine {
namespace {

constexpr float kMaxSigned = 127.0F;  // -128 is not used: weights and maps are symmetric
constexpr float kMaxUnsigned = 255.0F;

template <typename Stored>
void expand(const Stored* stored, int count, float scale, float* values) {
  for (int i = 0; i < count; ++i) values[i] = scale * static_cast<float>(stored[i]);
}

template <typename Stored>
void add(const Stored* stored, int count, float scale, float* sum) {
  for (int i = 0; i < count; ++i) sum[i] += scale * static_cast<float>(stored[i]);
}

/// Calls function(pointer to the first number of the span, count, scale).
template <typename Function>
void with_numbers(const Tensor& tensor, const PixelSpan& pixels, const Function& function) {
  const int count = pixels.count * tensor.shape.channels;
  const std::ptrdiff_t offset = std::ptrdiff_t{pixels.first} * tensor.shape.channels;
  switch (tensor.format.number) {
    case Number::kFloat:
      return function(tensor.floats() + offset, count, 1.0F);
    case Number::kSigned8:
      return function(reinterpret_cast<std::int8_t*>(tensor.data) + offset, count,
                      tensor.format.scale);
    case Number::kUnsigned8:
      return function(reinterpret_cast<std::uint8_t*>(tensor.data) + offset, count,
                      tensor.format.scale);
  }
}

/// In two loops over short pieces, so that the compiler vectorizes both.
template <typename Stored>
void shrink(const float* values, int count, float inverse_scale, float least, float most,
            Stored* stored) {
  // Adding it rounds a number to an integer in the lowest bits.
  constexpr float kRounding = 12582912.0F;  // 1.5 * 2^23
  constexpr int kPiece = 128;
  std::array<float, kPiece> whole{};
  for (int first = 0; first < count; first += kPiece) {
    const int length = std::min(kPiece, count - first);
    for (int i = 0; i < length; ++i) {
      const float limited = std::min(std::max(values[first + i] * inverse_scale, least), most);
      whole[static_cast<std::size_t>(i)] = limited + kRounding;
    }
    for (int i = 0; i < length; ++i) {
      const auto bits = std::bit_cast<std::uint32_t>(whole[static_cast<std::size_t>(i)]);
      stored[first + i] = static_cast<Stored>(bits);
    }
  }
}

}  // namespace

void quantize(const float* values, int count, float inverse_scale, std::int8_t* stored) {
  shrink(values, count, inverse_scale, -kMaxSigned, kMaxSigned, stored);
}

void load(const Tensor& tensor, const PixelSpan& pixels, float* channels) {
  with_numbers(tensor, pixels, [&](const auto* stored, int count, float scale) {
    expand(stored, count, scale, channels);
  });
}

void accumulate(const Tensor& tensor, const PixelSpan& pixels, float factor, float* sum) {
  with_numbers(tensor, pixels, [&](const auto* stored, int count, float scale) {
    add(stored, count, factor * scale, sum);
  });
}

void store(const Tensor& tensor, const PixelSpan& pixels, const float* channels) {
  with_numbers(tensor, pixels, [&]<typename Stored>(Stored* stored, int count, float scale) {
    if constexpr (std::is_same_v<Stored, float>) {
      std::copy_n(channels, count, stored);
    } else if constexpr (std::is_signed_v<Stored>) {
      quantize(channels, count, 1.0F / scale, stored);
    } else {
      shrink(channels, count, 1.0F / scale, 0.0F, kMaxUnsigned, stored);
    }
  });
}

Format byte_format(float range, bool non_negative) {
  const float largest = non_negative ? kMaxUnsigned : kMaxSigned;
  const float scale = std::max(range, std::numeric_limits<float>::min() * largest) / largest;
  return {non_negative ? Number::kUnsigned8 : Number::kSigned8, scale};
}

}  // namespace mms::engine
