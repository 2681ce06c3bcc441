#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mms/core/weights.hpp"

namespace mms {

/// How the numbers of a weights file are stored; 16 bits halve the file and keep 11 binary digits.
/// kInt8 is kFloat16 with one byte for each number of a tensor of whole numbers from -127 to 127.
enum class TensorType { kFloat32, kFloat16, kInt8 };

/// Reads a safetensors file. Tensors of F32, F16, BF16, F64, I64, I32 and I8 become floats.
/// @throws FileError when the file cannot be read; DataError naming the tensor for anything that
///         safetensors forbids (names that are there twice, data that is missing, left over, shared
///         by two tensors or of another size than shape and type say), for other types, and for
///         numbers that are not finite as floats.
Weights read_safetensors(const std::filesystem::path& path);

/// Like `read_safetensors`, from the bytes of a file called `where`.
Weights parse_safetensors(std::span<const std::uint8_t> bytes, const std::string& where);

/// Writes a safetensors file, whole or not at all, with the tensors in the order of their names.
/// 32 bits keep every value; 16 bits round to the nearest, ties to even, and a tensor with values
/// too large for them is written with 32.
/// @throws FileError when it cannot be written; DataError naming tensor and value when a number is
///         not finite, when values and shape do not fit each other, or for a name that safetensors
///         forbids.
void write_safetensors(const std::filesystem::path& path, const Weights& weights,
                       TensorType type = TensorType::kFloat32);

/// The bytes that `write_safetensors` writes to a file called `where`.
std::vector<std::uint8_t> encode_safetensors(const Weights& weights, TensorType type,
                                             const std::string& where);

}  // namespace mms
