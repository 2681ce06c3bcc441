#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mms {

/// Decompresses LZF, the compression of PCD files (format: Marc Lehmann's LibLZF).
/// @param size  of the result [B]
/// @returns nullopt if the data are damaged or have another size
std::optional<std::string> decompress_lzf(std::string_view data, std::size_t size);

}  // namespace mms
