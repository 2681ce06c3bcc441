#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <string>

namespace mms {

/// The largest number of frames an option may name; more than any recording has.
inline constexpr std::size_t kMaxFrames = 1'000'000'000;

/// Adds --threads, 1 to 256. @param threads  0 where it is not given: one a core
void add_threads_option(CLI::App& command, int& threads,
                        const std::string& help = "threads to use (default: one a core)");

/// Adds --frames, 1 to kMaxFrames. @param frames  unchanged where it is not given: all
void add_frames_option(CLI::App& command, std::size_t& frames, const std::string& help);

}  // namespace mms
