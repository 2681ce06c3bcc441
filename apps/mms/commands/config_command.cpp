#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "apps/mms/console/common_options.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/io/config/config_assignments.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/pipeline/system_config.hpp"

namespace mms {
namespace {

void add_dump(CLI::App& config) {
  const auto file = std::make_shared<std::string>();
  const auto set = std::make_shared<std::vector<std::string>>();
  CLI::App* command = config.add_subcommand("dump", "Print all settings with descriptions");
  command->add_option("FILE", *file, "settings to print instead of the defaults");
  add_set_option(*command, *set);
  command->callback([file, set] {
    SystemConfig settings;
    if (!file->empty()) print_warnings(load_config(*file, settings));
    print_warnings(assign(settings, *set, "--set"));
    fmt::print("{}", dump_config(settings));
  });
}

void add_check(CLI::App& config) {
  const auto file = std::make_shared<std::string>();
  CLI::App* command = config.add_subcommand("check", "Check a settings file");
  command->add_option("FILE", *file, "file to check")->required();
  command->callback([file] {
    SystemConfig settings;
    print_warnings(load_config(*file, settings));
    fmt::print("{}: valid\n", *file);
  });
}

}  // namespace

void add_config_command(CLI::App& app) {
  CLI::App* config = app.add_subcommand("config", "Show or check settings");
  config->require_subcommand(1);
  add_dump(*config);
  add_check(*config);
}

}  // namespace mms
