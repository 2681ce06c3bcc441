#pragma once

// Internal to io: the JSON that stands before the numbers of a safetensors file.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// Bytes of the number before the header: its length. The header is padded to a multiple of it.
inline constexpr std::size_t kSafetensorsLength = 8;

/// Key of the free texts, which no tensor may be called by.
inline constexpr std::string_view kSafetensorsMetadata = "__metadata__";

/// As large as the format's reference implementation allows [B].
inline constexpr std::uint64_t kMaxSafetensorsHeader = 100'000'000;

/// How one number is stored; little-endian all of them.
enum class ElementType { kF32, kF16, kBf16, kF64, kI64, kI32, kI8 };

/// Size of one number [B].
std::uint64_t bytes_of(ElementType type);

/// Where the numbers of one tensor are.
struct StoredTensor {
  std::string name;                      ///< unique in the file
  ElementType type = ElementType::kF32;  ///< of each number
  std::vector<std::int64_t> shape;       ///< empty for a scalar
  std::uint64_t begin = 0;               ///< first byte, counted from the header's end
  std::uint64_t end = 0;  ///< one after the last; the range has just the size of shape and type
};

/// Everything in the file but the numbers.
struct SafetensorsHeader {
  std::map<std::string, std::string> metadata;  ///< free texts by key
  std::vector<StoredTensor> tensors;            ///< as their data follows one another, with no gap
};

/// Reads the header of a file called `where`, strictly: nothing unknown, nothing twice.
/// @throws DataError naming tensor and key, as in "conv1.weight.shape[0]".
SafetensorsHeader parse_safetensors_header(std::string_view json, const std::string& where);

/// Throws the DataError for a number that a tensor of numbers up to `largest` cannot hold.
[[noreturn]] void fail_value(const std::string& where, const std::string& tensor, std::size_t index,
                             double value, double largest);

}  // namespace mms
