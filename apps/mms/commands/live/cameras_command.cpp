#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/mms/console/warnings.hpp"
#include "mms/dataset/camera/camera_device.hpp"

namespace mms {
namespace {

void print_cameras_json(const std::vector<CameraInfo>& cameras) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CameraInfo& camera : cameras) {
    list.push_back({{"address", camera.address},
                    {"name", camera.name},
                    {"vendor", camera.vendor},
                    {"uri", camera.uri},
                    {"modes", camera.modes},
                    {"fault", camera.fault}});
  }
  fmt::print("{}\n", list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print_cameras(const std::vector<CameraInfo>& cameras) {
  for (const CameraInfo& camera : cameras) {
    fmt::print("{}  {}{}{}\n  uri    {}\n", camera.address, camera.vendor,
               camera.vendor.empty() ? "" : " ", camera.name, camera.uri);
    for (const std::string& mode : camera.modes) fmt::print("  mode   {}\n", mode);
    if (!camera.fault.empty()) fmt::print("  fault  {}\n", camera.fault);
  }
  if (!cameras.empty()) return;
  fmt::print(
      "no camera was found (is it plugged in? Drivers of other manufacturers go into "
      "OpenNI2/Drivers: docs/cameras.md)\n");
}

}  // namespace

void add_cameras_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("cameras", "List the depth cameras that are plugged in (OpenNI2, V4L2)");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print one JSON list");
  command->callback([json] {
    const CameraList list = list_cameras();
    print_warnings(list.faults);
    *json ? print_cameras_json(list.cameras) : print_cameras(list.cameras);
  });
}

}  // namespace mms
