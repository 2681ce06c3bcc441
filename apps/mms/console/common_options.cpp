#include "apps/mms/console/common_options.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>

namespace mms {

void add_threads_option(CLI::App& command, int& threads, const std::string& help) {
  constexpr int kMaxThreads = 256;  // more than any present machine has cores
  command.add_option("--threads", threads, help)->check(CLI::Range(1, kMaxThreads));
}

void add_set_option(CLI::App& command, std::vector<std::string>& set) {
  command
      .add_option("--set", set, "a setting as group.key=value, after those of --config; repeatable")
      ->allow_extra_args(false);
}

void add_sequence_option(CLI::App& command, std::string& sequence) {
  command.add_option("--sequence", sequence, "sequence of KITTI odometry below DATA, e.g. 00");
}

std::string with_sequence(const std::string& data, const std::string& sequence) {
  if (sequence.empty()) return data;
  return (std::filesystem::path(data) / "sequences" / sequence).string();
}

void add_frames_option(CLI::App& command, std::size_t& frames, const std::string& help) {
  command.add_option("--frames", frames, help)
      ->check(CLI::Range(std::size_t{1}, kMaxFrames))
      ->default_str("all");
}

}  // namespace mms
