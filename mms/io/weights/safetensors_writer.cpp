#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/weights/half_float.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/io/weights/safetensors_header.hpp"

namespace mms {
namespace {

/// Name and size of a number format.
struct Format {
  const char* name;
  std::size_t bytes;  ///< per number
};

Format format_of(TensorType type) {
  if (type == TensorType::kInt8) return {"I8", 1};
  return type == TensorType::kFloat16 ? Format{"F16", 2} : Format{"F32", 4};
}

bool holds_bytes(const WeightTensor& tensor) {
  return std::all_of(tensor.values.begin(), tensor.values.end(), [](float value) {
    return value == std::round(value) && std::abs(value) <= std::numeric_limits<std::int8_t>::max();
  });
}

/// float32 for a tensor with values beyond float16.
TensorType type_of(const WeightTensor& tensor, TensorType requested) {
  if (requested == TensorType::kFloat32) return requested;
  if (requested == TensorType::kInt8 && holds_bytes(tensor)) return requested;
  const bool fits = std::all_of(tensor.values.begin(), tensor.values.end(), [](float value) {
    return !std::isfinite(value) || half_from_float(value).has_value();
  });
  return fits ? TensorType::kFloat16 : TensorType::kFloat32;
}

template <class Unsigned>
void append_little_endian(Unsigned value, std::vector<std::uint8_t>& bytes) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
}

void check_tensor(const std::string& name, const WeightTensor& tensor, const std::string& where) {
  if (name == kSafetensorsMetadata) {
    throw DataError(where, "the tensor name '" + name + "'");
  }
  std::int64_t count = 1;
  for (const std::int64_t side : tensor.shape) {
    if (side < 0 || __builtin_mul_overflow(count, side, &count)) count = -1;
    if (count < 0) break;
  }
  if (count == static_cast<std::int64_t>(tensor.values.size())) return;
  throw DataError(where, "tensor '" + name + "' has " + std::to_string(tensor.values.size()) +
                             " values, expected the product of its shape");
}

/// The header: tensors with consecutive data, padded with spaces.
std::string describe(const Weights& weights, TensorType type, const std::string& where) {
  nlohmann::ordered_json header = nlohmann::ordered_json::object();
  if (!weights.metadata.empty()) header[std::string(kSafetensorsMetadata)] = weights.metadata;
  std::size_t end = 0;
  for (const auto& [name, tensor] : weights.tensors) {
    check_tensor(name, tensor, where);
    const std::size_t begin = end;
    const Format format = format_of(type_of(tensor, type));
    end += tensor.values.size() * format.bytes;
    header[name] = {
        {"dtype", format.name}, {"shape", tensor.shape}, {"data_offsets", {begin, end}}};
  }
  try {
    std::string text = header.dump();
    text.append((kSafetensorsLength - text.size() % kSafetensorsLength) % kSafetensorsLength, ' ');
    return text;
  } catch (const nlohmann::json::exception&) {
    throw DataError(where, "a name or a metadata text is not UTF-8");
  }
}

void append_value(float value, TensorType type, const std::string& name, std::size_t index,
                  const std::string& where, std::vector<std::uint8_t>& bytes) {
  if (type == TensorType::kInt8) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::int8_t>(value)));
  } else if (type == TensorType::kFloat32) {
    if (!std::isfinite(value)) {
      fail_value(where, name, index, value, std::numeric_limits<float>::max());
    }
    append_little_endian(std::bit_cast<std::uint32_t>(value), bytes);
  } else {
    constexpr double kMaxHalf = 65504.0;
    const std::optional<std::uint16_t> half = half_from_float(value);
    if (!half) fail_value(where, name, index, value, kMaxHalf);
    append_little_endian(*half, bytes);
  }
}

}  // namespace

std::vector<std::uint8_t> encode_safetensors(const Weights& weights, TensorType type,
                                             const std::string& where) {
  const std::string header = describe(weights, type, where);
  std::vector<std::uint8_t> bytes;
  append_little_endian<std::uint64_t>(header.size(), bytes);
  bytes.insert(bytes.end(), header.begin(), header.end());
  for (const auto& [name, tensor] : weights.tensors) {
    const TensorType own = type_of(tensor, type);
    for (std::size_t i = 0; i < tensor.values.size(); ++i) {
      append_value(tensor.values[i], own, name, i, where, bytes);
    }
  }
  return bytes;
}

void write_safetensors(const std::filesystem::path& path, const Weights& weights, TensorType type) {
  write_file(path, encode_safetensors(weights, type, path.string()));
}

}  // namespace mms
