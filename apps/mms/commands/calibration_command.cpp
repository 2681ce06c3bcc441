#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/mms/commands/calibration_options.hpp"
#include "apps/mms/commands/commands.hpp"
#include "apps/mms/console/overwrite_option.hpp"
#include "mms/io/config/calibration_formats.hpp"
#include "mms/io/config/calibration_io.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

struct CalibrationArguments {
  fs::path input;
  fs::path output;
  std::optional<double> depth_scale;
  bool overwrite = false;
};

void convert_calibration(const CalibrationArguments& arguments) {
  FormattedCalibration read = read_any_calibration(arguments.input);
  if (arguments.depth_scale) read.calibration.depth_scale = *arguments.depth_scale;
  refuse_existing_file(arguments.output, arguments.overwrite);
  write_calibration(arguments.output, read.calibration);
  fmt::print("{}: calibration of {} ({})\n", arguments.output.string(), arguments.input.string(),
             read.format);
  if (read.assumed_depth_scale && !arguments.depth_scale) {
    fmt::print("depth scale: none in the file, 1000 units per meter assumed (--depth-scale)\n");
  }
}

}  // namespace

void add_calibration_command(CLI::App& app) {
  CLI::App* calibration = app.add_subcommand("calibration", "Convert calibration files");
  calibration->require_subcommand(1);
  const auto arguments = std::make_shared<CalibrationArguments>();
  CLI::App* command = calibration->add_subcommand(
      "convert",
      "Write calibration.yaml from a file of ROS, OpenCV, Kalibr, EuRoC, ORB-SLAM or "
      "Open3D");
  command->add_option("IN", arguments->input, "calibration file")->required();
  command->add_option("-o,--output", arguments->output, "file to write")->required();
  add_depth_scale_option(*command, arguments->depth_scale);
  add_overwrite_flag(*command, arguments->overwrite);
  command->callback([arguments] { convert_calibration(*arguments); });
}

}  // namespace mms
