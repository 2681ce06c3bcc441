#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace mms {

/// Compression of a block of a recording.
enum class Compression { kNone, kBz2, kLz4, kZstd };

/// The compression of that name in ROS 1 bags and MCAP: "" or "none", "bz2", "lz4", "zstd".
/// @throws DataError at `where` for others.
Compression compression_of(std::string_view name, const std::string& where);

/// Decompresses a whole block of untrusted bytes. Memory grows with what is decompressed.
/// @param limit  largest result [B]
/// @throws DataError at `where` if it is damaged, incomplete or larger than the limit.
std::string decompress(std::string_view bytes, Compression compression, std::size_t limit,
                       const std::string& where);

/// As decompress, but the part before the damage.
std::string decompress_start(std::string_view bytes, Compression compression, std::size_t limit);

/// Compresses a block as one zstd frame with its checksum, at its fastest level.
std::string compress_zstd(std::string_view bytes);

/// Whether the bytes begin as a zstd frame.
bool is_zstd(std::string_view bytes);

/// Decompresses a zstd file into a new file; of a damaged one the part before the damage, whose
/// reader finds where it ends.
/// @throws FileError if a file cannot be read or written; DataError if it is not a zstd file.
void decompress_zstd_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace mms
