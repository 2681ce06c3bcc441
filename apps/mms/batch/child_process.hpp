#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mms {

/// Runs this program with other arguments and waits for its end. It gets no input, its output goes
/// into a file, and it ends if this process is killed.
/// @param arguments  without the name of the program
/// @param log        replaced
/// @returns the exit status; 128 + number of the signal that ended it
/// @throws FileError if the file cannot be written, or no process can be made
int run_self(const std::vector<std::string>& arguments, const std::filesystem::path& log);

}  // namespace mms
