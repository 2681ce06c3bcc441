#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <string>
#include <vector>

namespace mms {

/// Largest value of an option for a number of frames.
inline constexpr std::size_t kMaxFrames = 1'000'000'000;

/// Adds --threads, 1 to 256.
/// @param threads  0 by default: one per core
void add_threads_option(CLI::App& command, int& threads,
                        const std::string& help = "threads to use (default: one per core)");

/// Adds --set for settings of the system: "group.key=value", repeatable.
void add_set_option(CLI::App& command, std::vector<std::string>& set);

/// Adds --sequence, a folder below DATA/sequences.
void add_sequence_option(CLI::App& command, std::string& sequence);

/// DATA, or its sequence if one is given.
std::string with_sequence(const std::string& data, const std::string& sequence);

/// Adds --frames, 1 to kMaxFrames.
/// @param frames  unchanged by default: all
void add_frames_option(CLI::App& command, std::size_t& frames, const std::string& help);

}  // namespace mms
