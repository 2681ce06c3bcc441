#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mms/core/weights.hpp"

namespace mms {

/// Number format of a weights file. kFloat16 halves the size and keeps 11 binary digits. kInt8 is
/// kFloat16 with one byte per number for tensors of integers from -127 to 127.
enum class TensorType { kFloat32, kFloat16, kInt8 };

/// Reads a safetensors file. Tensors of F32, F16, BF16, F64, I64, I32 and I8 become floats.
/// @throws FileError if the file cannot be read; DataError with the tensor for violations of the
/// format (duplicate names; data that are missing, left over, shared by two tensors or of a size
/// other than shape and type give), for other types, and for numbers that are not finite as floats.
Weights read_safetensors(const std::filesystem::path& path);

/// Like `read_safetensors`, from the bytes of a file called `where`.
Weights parse_safetensors(std::span<const std::uint8_t> bytes, const std::string& where);

/// Writes a safetensors file atomically, with the tensors sorted by name. 32 bits keep every value;
/// 16 bits round to nearest, ties to even; a tensor with larger values is written with 32 bits.
/// @throws FileError if it cannot be written; DataError with tensor and value if a number is not
/// finite, values and shape do not match, or a name is not allowed.
void write_safetensors(const std::filesystem::path& path, const Weights& weights,
                       TensorType type = TensorType::kFloat32);

/// The bytes that `write_safetensors` writes to a file called `where`.
std::vector<std::uint8_t> encode_safetensors(const Weights& weights, TensorType type,
                                             const std::string& where);

}  // namespace mms
