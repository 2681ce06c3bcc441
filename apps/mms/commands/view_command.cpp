#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/mms/console/viewing.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/run/view/recorded_scene.hpp"
#include "mms/run/view/serve.hpp"

namespace mms {
namespace {

struct ViewArguments {
  std::filesystem::path folder = "results/latest";
  ViewOptions options;
};

void view(const ViewArguments& arguments) {
  std::vector<std::string> warnings;
  const std::shared_ptr<Scene> scene = open_recorded_scene(arguments.folder, warnings);
  print_warnings(warnings);
  const auto server = serve(arguments.options, scene, "--port N", false);
  announce(*server, arguments.options);
  if (!scene->info().has_pictures) {
    fmt::print(stderr, "warning: no images and scans to show: {}\n", scene->info().pictures_note);
  }
  fmt::print(stderr, "{}: {} frames, shown until Ctrl-C\n", arguments.folder.string(),
             scene->size());
  wait_for_interrupt();
}

}  // namespace

void add_view_command(CLI::App& app) {
  const auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command = app.add_subcommand("view", "Show a finished or killed run in a browser");
  command->add_option("DIR", arguments->folder, "result folder of mms run")->capture_default_str();
  command->add_option("--port", arguments->options.port, "port of the viewer; 0: any free port")
      ->capture_default_str();
  add_bind_option(*command, arguments->options);
  command->callback([arguments] { view(*arguments); });
}

}  // namespace mms
