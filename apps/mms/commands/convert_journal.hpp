#pragma once

#include <filesystem>

#include "mms/io/journal/journal.hpp"

namespace mms {

/// Writes the trajectory and the map of a run that did not come to its end, and says on stdout how
/// far they go.
/// @param input   a result folder with a journal, or the journal
/// @param output  folder, made where there is none; empty: that of the journal
/// @throws FileError, DataError when there is no journal, none of a frame, or no place to write to.
void convert_journal(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace mms
