#include "apps/mms/commands/commands.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/mms/commands/convert_files.hpp"
#include "apps/mms/commands/convert_journal.hpp"
#include "apps/mms/commands/convert_recording.hpp"
#include "apps/mms/commands/topic_options.hpp"

namespace mms {
namespace {

struct ConvertArguments {
  std::filesystem::path input;
  std::filesystem::path output;  ///< empty: beside the input
  std::filesystem::path stamps;  ///< empty: none
  BagTopicNames topics;
  bool compressed = false;
};

void convert(const ConvertArguments& arguments) {
  if (is_recording_conversion(arguments.input.string(), arguments.output)) {
    return convert_recording(
        {arguments.input.string(), arguments.output, arguments.topics, arguments.compressed});
  }
  const bool journal =
      std::filesystem::is_directory(arguments.input) || arguments.input.filename() == kJournalName;
  if (journal) {
    convert_journal(arguments.input, arguments.output);
  } else {
    convert_file(arguments.input, arguments.output, arguments.stamps);
  }
}

}  // namespace

void add_convert_command(CLI::App& app) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand(
      "convert",
      "Turn trajectories (.tum, _kitti.txt), clouds (.ply, .pcd) and recordings (folders, .bag) "
      "into one another, or the journal of a run that was killed into its trajectory and map");
  command
      ->add_option("IN", arguments->input,
                   "file, recording, sim:SCENE, or the result folder of a run that did not come to "
                   "its end")
      ->required();
  command->add_option(
      "-o,--output", arguments->output,
      "file, its format by its extension, or the folder for what a journal or a bag "
      "holds: a bag becomes a TUM-layout sequence, one of LiDAR scans KITTI's "
      "(default: beside IN in the other format, or into the result folder)");
  command->add_option(
      "--stamps", arguments->stamps,
      "file with a stamp [s] at the start of each line, a TUM trajectory or KITTI's "
      "times.txt: KITTI trajectories have none of their own");
  command->add_flag("--compressed", arguments->compressed,
                    "write images into a bag as JPEG, and depth as PNG in millimetres");
  add_topic_options(*command, arguments->topics);
  command->callback([arguments] { convert(*arguments); });
}

}  // namespace mms
