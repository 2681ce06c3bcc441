#pragma once

#include <filesystem>

namespace mms {

/// Writes a trajectory or a cloud in another format, and prints a summary on stdout.
/// @param input   .tum or .txt (TUM or KITTI, by its columns), .ply or .pcd
/// @param output  of the same kind; empty: next to the input in the other format
/// @param stamps  file whose lines begin with the stamps of a KITTI trajectory's poses; empty: none
/// @param level   in the level map frame of map.yaml beside the input: z up, x forward at the
/// start,
///                origin on the floor
/// @throws DataError for an unknown or unsuitable extension and invalid files; FileError if the
/// output exists, unless `overwrite`.
void convert_file(const std::filesystem::path& input, const std::filesystem::path& output,
                  const std::filesystem::path& stamps, bool level, bool overwrite);

}  // namespace mms
