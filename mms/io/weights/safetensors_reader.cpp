#include "mms/io/weights/safetensors.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/weights/half_float.hpp"
#include "mms/io/weights/safetensors_header.hpp"

namespace mms {
namespace {

constexpr const char* kFormatHint = "is it a safetensors file? convert a .pth file to one";
constexpr const char* kCopyHint = "copy it again";

template <class Unsigned>
Unsigned little_endian(const std::uint8_t* bytes) {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    value = static_cast<Unsigned>(value | static_cast<Unsigned>(bytes[i]) << (8 * i));
  }
  return value;
}

/// A double holds every stored number, integers to 53 bits.
double number_at(const std::uint8_t* bytes, ElementType type) {
  switch (type) {
    case ElementType::kF32:
      return std::bit_cast<float>(little_endian<std::uint32_t>(bytes));
    case ElementType::kF16:
      return float_from_half(little_endian<std::uint16_t>(bytes));
    case ElementType::kBf16:
      return float_from_bfloat(little_endian<std::uint16_t>(bytes));
    case ElementType::kF64:
      return std::bit_cast<double>(little_endian<std::uint64_t>(bytes));
    case ElementType::kI64:
      return static_cast<double>(static_cast<std::int64_t>(little_endian<std::uint64_t>(bytes)));
    case ElementType::kI32:
      return static_cast<std::int32_t>(little_endian<std::uint32_t>(bytes));
    case ElementType::kI8:
      break;
  }
  return static_cast<std::int8_t>(*bytes);
}

WeightTensor decode(const StoredTensor& stored, std::span<const std::uint8_t> data,
                    const std::string& where) {
  constexpr double kMaxFloat = std::numeric_limits<float>::max();
  const std::size_t step = bytes_of(stored.type);
  WeightTensor tensor{stored.shape, std::vector<float>((stored.end - stored.begin) / step)};
  const std::uint8_t* bytes = data.data() + stored.begin;
  for (std::size_t i = 0; i < tensor.values.size(); ++i, bytes += step) {
    const double value = number_at(bytes, stored.type);
    if (!(std::abs(value) <= kMaxFloat)) fail_value(where, stored.name, i, value, kMaxFloat);
    tensor.values[i] = static_cast<float>(value);
  }
  return tensor;
}

[[noreturn]] void fail_truncated(const std::string& where, std::uint64_t size,
                                 std::uint64_t expected) {
  throw DataError(where,
                  "is truncated: " + std::to_string(expected - size) + " of its " +
                      std::to_string(expected) + " bytes are missing",
                  kCopyHint);
}

/// The JSON between the length and the data.
std::string_view header_text(std::span<const std::uint8_t> bytes, const std::string& where) {
  if (bytes.size() < kSafetensorsLength) fail_truncated(where, bytes.size(), kSafetensorsLength);
  const auto length = little_endian<std::uint64_t>(bytes.data());
  if (length > kMaxSafetensorsHeader) {
    throw DataError(where,
                    "its header has " + std::to_string(length) + " bytes, allowed: up to " +
                        std::to_string(kMaxSafetensorsHeader),
                    kFormatHint);
  }
  if (length > bytes.size() - kSafetensorsLength) {
    fail_truncated(where, bytes.size(), kSafetensorsLength + length);
  }
  return {reinterpret_cast<const char*>(bytes.data()) + kSafetensorsLength, length};
}

void check_data_size(const SafetensorsHeader& header, std::uint64_t before, std::uint64_t size,
                     const std::string& where) {
  const std::uint64_t expected = header.tensors.empty() ? 0 : header.tensors.back().end;
  if (size < expected) fail_truncated(where, before + size, before + expected);
  if (size == expected) return;
  throw DataError(where, "has " + std::to_string(size - expected) +
                             " bytes after its last tensor, allowed: none");
}

}  // namespace

Weights parse_safetensors(std::span<const std::uint8_t> bytes, const std::string& where) {
  const std::string_view text = header_text(bytes, where);
  SafetensorsHeader header = parse_safetensors_header(text, where);
  const std::size_t before = kSafetensorsLength + text.size();
  const std::span<const std::uint8_t> data = bytes.subspan(before);
  check_data_size(header, before, data.size(), where);
  Weights weights{std::move(header.metadata), {}};
  for (const StoredTensor& stored : header.tensors) {
    weights.tensors[stored.name] = decode(stored, data, where);
  }
  return weights;
}

Weights read_safetensors(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  return parse_safetensors({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                           path.string());
}

}  // namespace mms
