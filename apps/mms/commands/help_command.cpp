#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "apps/mms/commands/commands.hpp"
#include "mms/io/text/nearest_word.hpp"

namespace mms {
namespace {

/// The subcommand of that name.
/// @throws CLI::ValidationError if there is none.
const CLI::App& find_command(const CLI::App& command, const std::string& name) {
  std::vector<std::string> known;
  for (const CLI::App* one : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (one->get_name() == name) return *one;
    if (!one->get_group().empty()) known.push_back(one->get_name());
  }
  throw CLI::ValidationError("help", "no command '" + name + "'; " + suggestion(name, known));
}

}  // namespace

void add_help_command(CLI::App& app) {
  const auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* help = app.add_subcommand("help", "Show the help of a command");
  help->add_option("COMMAND", *words, "as in: mms help eval drift");
  help->callback([words, &app] {
    const CLI::App* command = &app;
    std::string parents;
    for (const std::string& word : *words) {
      parents += (parents.empty() ? "" : " ") + command->get_name();
      command = &find_command(*command, word);
    }
    fmt::print("{}", command->help(parents));
  });
}

}  // namespace mms
