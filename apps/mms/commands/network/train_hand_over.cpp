#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/mms/commands/commands.hpp"
#include "mms/core/error.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOther = "mms-torch";

fs::path other_program() {
  std::error_code fault;
  return fs::read_symlink("/proc/self/exe", fault).parent_path() / kOther;
}

/// Replaces the process by the other program with these arguments.
void hand_over(std::vector<std::string> arguments) {
  const std::string program = other_program().string();
  std::vector<char*> list;
  for (std::string& argument : arguments) list.push_back(argument.data());
  list.push_back(nullptr);
  execv(program.c_str(), list.data());
  throw Error(program, std::string("cannot be started: ") + std::strerror(errno),
              "training requires it; it is part of builds with -DMMS_WITH_TORCH=ON");
}

}  // namespace

void add_train_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("train", "Train the segmentation network (with mms-torch)");
  command->set_help_flag();
  command->prefix_command();
  command->callback([command] {
    std::vector<std::string> arguments = {kOther, "train"};
    for (const std::string& argument : command->remaining()) arguments.push_back(argument);
    hand_over(std::move(arguments));
  });
}

}  // namespace mms
