#include "apps/mms/console/usage.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace mms {
namespace {

/// The commands of the line, outermost first: mms, eval, drift.
std::vector<const CLI::App*> chain_of(const CLI::App& app) {
  std::vector<const CLI::App*> chain = {&app};
  while (!chain.back()->get_subcommands().empty()) {
    chain.push_back(chain.back()->get_subcommands().back());
  }
  return chain;
}

/// "trajectory, drift or map".
std::string listed_commands(const CLI::App& command) {
  const std::vector<const CLI::App*> all = command.get_subcommands([](const CLI::App* candidate) {
    return !candidate->get_group().empty();  // no group: a former name, hidden
  });
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == all.size() ? " or " : ", ") + all[i]->get_name();
  }
  return text;
}

std::string fault_of(const CLI::App& command, const CLI::ParseError& error) {
  if (command.get_require_subcommand_min() == 0) return error.what();
  const std::vector<std::string> unknown = command.remaining();
  if (unknown.empty()) return "a command is required: " + listed_commands(command);
  if (unknown.front().starts_with("-")) return fmt::format("unknown option '{}'", unknown.front());
  return fmt::format("unknown command '{}', expected {}", unknown.front(),
                     listed_commands(command));
}

}  // namespace

std::string usage_fault(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<const CLI::App*> chain = chain_of(app);
  std::string help;
  for (const CLI::App* command : chain) help += command->get_name() + " ";
  std::string line = fmt::format("{} ({}--help)", fault_of(*chain.back(), error), help);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

}  // namespace mms
