#pragma once

// Internal to io: the JSON header of a safetensors file.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// Bytes of the length before the header. The header is padded to a multiple of it.
inline constexpr std::size_t kSafetensorsLength = 8;

/// Key of the metadata; not allowed as a tensor's name.
inline constexpr std::string_view kSafetensorsMetadata = "__metadata__";

/// Limit of the format's reference implementation [B].
inline constexpr std::uint64_t kMaxSafetensorsHeader = 100'000'000;

/// Number format of a tensor, little-endian.
enum class ElementType { kF32, kF16, kBf16, kF64, kI64, kI32, kI8 };

/// Size of one number [B].
std::uint64_t bytes_of(ElementType type);

/// Location of a tensor's numbers.
struct StoredTensor {
  std::string name;                      ///< unique in the file
  ElementType type = ElementType::kF32;  ///< of each number
  std::vector<std::int64_t> shape;       ///< empty for a scalar
  std::uint64_t begin = 0;               ///< first byte, relative to the end of the header
  std::uint64_t end = 0;                 ///< one after the last byte
};

/// Everything in the file but the numbers.
struct SafetensorsHeader {
  std::map<std::string, std::string> metadata;  ///< free texts by key
  std::vector<StoredTensor> tensors;            ///< in the order of their data, without gaps
};

/// Parses the header of a file called `where`, strictly: no unknown and no duplicate keys.
/// @throws DataError with tensor and key, as in "conv1.weight.shape[0]".
SafetensorsHeader parse_safetensors_header(std::string_view json, const std::string& where);

/// Throws the DataError for a number above `largest`.
[[noreturn]] void fail_value(const std::string& where, const std::string& tensor, std::size_t index,
                             double value, double largest);

}  // namespace mms
