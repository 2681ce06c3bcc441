#pragma once

#include <filesystem>

namespace mms {

/// Checks what OpenNI2 believes of a recording (.oni): sizes, names, nodes and places of records,
/// up to the end or to where the file was cut.
/// @throws FileError if the file cannot be read; DataError with the place of the first fault.
void check_oni_records(const std::filesystem::path& path);

}  // namespace mms
