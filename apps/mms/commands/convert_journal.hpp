#pragma once

#include <filesystem>

#include "mms/io/journal/journal.hpp"

namespace mms {

/// Writes the trajectory and the map of a killed run, and prints a summary on stdout.
/// @param input   a result folder with a journal, or the journal
/// @param output  folder, created if missing; empty: that of the journal
/// @throws FileError, DataError if there is no valid journal, the output cannot be written, or
/// exists and `overwrite` is not set.
void convert_journal(const std::filesystem::path& input, const std::filesystem::path& output,
                     bool overwrite);

}  // namespace mms
