#include "apps/mms/commands/commands.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/mms/commands/calibration_options.hpp"
#include "apps/mms/commands/convert_files.hpp"
#include "apps/mms/commands/convert_journal.hpp"
#include "apps/mms/commands/convert_recording.hpp"
#include "apps/mms/commands/topic_options.hpp"
#include "apps/mms/console/overwrite_option.hpp"

namespace mms {
namespace {

struct ConvertArguments {
  std::filesystem::path input;
  std::filesystem::path output;  ///< empty: next to the input
  std::filesystem::path stamps;  ///< empty: none
  BagTopicNames topics;
  CameraOptions camera;
  std::optional<double> rate;
  std::string frame = "sensor";  ///< or "level"
  bool compressed = false;
  bool overwrite = false;
};

void convert(const ConvertArguments& arguments) {
  if (is_recording_conversion(arguments.input.string(), arguments.output)) {
    return convert_recording({arguments.input.string(), arguments.output, arguments.topics,
                              arguments.camera, arguments.rate, arguments.compressed,
                              arguments.overwrite});
  }
  const bool journal =
      std::filesystem::is_directory(arguments.input) || arguments.input.filename() == kJournalName;
  if (journal) {
    convert_journal(arguments.input, arguments.output, arguments.overwrite);
  } else {
    convert_file(arguments.input, arguments.output, arguments.stamps, arguments.frame == "level",
                 arguments.overwrite);
  }
}

}  // namespace

void add_convert_command(CLI::App& app) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand(
      "convert",
      "Convert trajectories (.tum, _kitti.txt), clouds (.ply, .pcd) and recordings (folders, "
      ".bag, .mcap, .pcap), or recover trajectory and map from the journal of a killed run");
  command
      ->add_option("IN", arguments->input,
                   "file, recording, sim:SCENE, or the result folder of a killed run")
      ->required();
  command->add_option("-o,--output", arguments->output,
                      "output file, its format by extension, or output folder for a bag or "
                      "journal: a bag becomes a TUM-layout sequence, with LiDAR scans a KITTI "
                      "folder (default: next to IN in the other format, or the result folder)");
  command->add_option("--stamps", arguments->stamps,
                      "file with a stamp [s] at the start of each line, a TUM trajectory or "
                      "KITTI's times.txt, for KITTI trajectories, which have no stamps");
  command->add_flag("--compressed", arguments->compressed,
                    "write images into a bag as JPEG, and depth as PNG in millimeters");
  command
      ->add_option("--frame", arguments->frame,
                   "of a trajectory or cloud of a run: that of the first sensor pose, or the level "
                   "one of map.yaml beside it, with z up")
      ->check(CLI::IsMember({"sensor", "level"}))
      ->capture_default_str();
  add_overwrite_flag(*command, arguments->overwrite);
  add_rate_option(*command, arguments->rate);
  add_topic_options(*command, arguments->topics);
  add_calibration_options(*command, arguments->camera);
  command->callback([arguments] { convert(*arguments); });
}

}  // namespace mms
