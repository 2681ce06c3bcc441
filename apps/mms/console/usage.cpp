#include "apps/mms/console/usage.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "mms/io/text/nearest_word.hpp"

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

/// Names of the subcommands without former ones, which have no group.
std::vector<std::string> command_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* one : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (!one->get_group().empty()) names.push_back(one->get_name());
  }
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// "trajectory, drift or map".
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  return text;
}

std::string unknown_option(const CLI::App& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  const auto meant = nearest_word(name, option_names(command));
  return fmt::format("unknown option '{}'", name) +
         (meant ? fmt::format(", did you mean '{}'?", *meant) : "");
}

std::string unknown_command(const CLI::App& command, const std::string& word) {
  const std::vector<std::string> names = command_names(command);
  const auto meant = nearest_word(word, names);
  return fmt::format("unknown command '{}', ", word) +
         (meant ? fmt::format("did you mean '{}'?", *meant) : "expected " + listed(names));
}

/// An unknown option is named first: what it leaves over or makes missing only follows from it.
std::string fault_of(const CLI::App& command, const CLI::ParseError& error) {
  const std::vector<std::string> unknown = command.remaining();
  const auto option = std::find_if(unknown.begin(), unknown.end(), [](const std::string& word) {
    return word.size() > 1 && word.starts_with("-");
  });
  if (option != unknown.end()) return unknown_option(command, *option);
  if (command.get_require_subcommand_min() > 0) {
    return unknown.empty() ? "no command given, expected " + listed(command_names(command))
                           : unknown_command(command, unknown.front());
  }
  if (!unknown.empty()) return fmt::format("unexpected argument '{}'", unknown.front());
  return error.what();
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
