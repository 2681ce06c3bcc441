#include "apps/mms/commands/commands.hpp"
#include "apps/mms/console/overwrite_option.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "mms/core/error.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/segmentation/detection/coco_classes.hpp"
#include "mms/segmentation/weights/checkpoint_import.hpp"
#include "mms/segmentation/weights/model.hpp"

namespace mms {
namespace {

struct ImportArguments {
  std::filesystem::path checkpoint;
  std::filesystem::path output;
  std::vector<std::string> classes;
  bool half = false;
  bool overwrite = false;
};

/// The given names, or COCO's if their number fits, or numbers.
std::vector<std::string> names_for(const NetworkConfig& config,
                                   const std::vector<std::string>& given) {
  const auto count = static_cast<std::size_t>(config.classes);
  if (!given.empty() && given.size() != count) {
    throw DataError("--classes", fmt::format("has {} class names, the network has {} classes",
                                             given.size(), count));
  }
  if (!given.empty()) return given;
  if (count == coco_classes().size()) return coco_classes();
  throw DataError(
      "--classes",
      fmt::format(
          "is required: the network has {} classes, and only the names of COCO's {} are known",
          count, coco_classes().size()));
}

void import(const ImportArguments& arguments) {
  const std::string where = arguments.checkpoint.string();
  refuse_existing_file(arguments.output, arguments.overwrite);
  ImportedNetwork imported = import_checkpoint(read_safetensors(arguments.checkpoint), where);
  SegmentationModel model = {imported.config, names_for(imported.config, arguments.classes),
                             std::move(imported.weights)};
  const std::size_t tensors = model.weights.tensors.size();
  const auto note = model.weights.metadata.find("note");
  if (note != model.weights.metadata.end()) fmt::print(stderr, "warning: {}\n", note->second);
  write_safetensors(arguments.output, pack_model(std::move(model)),
                    arguments.half ? TensorType::kFloat16 : TensorType::kFloat32);
  fmt::print("{}: {} tensors of\n{}", arguments.output.string(), tensors,
             dump_config(imported.config));
}

}  // namespace

void add_import_command(CLI::App& app) {
  const auto arguments = std::make_shared<ImportArguments>();
  CLI::App* command =
      app.add_subcommand("import", "Convert a SOLOv2 checkpoint of MMDetection, SOLO or AdelaiDet");
  command
      ->add_option("CHECKPOINT", arguments->checkpoint,
                   "its state_dict as safetensors (see docs/training.md)")
      ->required();
  command->add_option("-o,--output", arguments->output, "weights file to write")->required();
  command
      ->add_option("--classes", arguments->classes,
                   "comma-separated class names (default: COCO's 80)")
      ->delimiter(',');
  add_overwrite_flag(*command, arguments->overwrite);
  command->add_flag("--half", arguments->half, "write float16, half the size");
  command->callback([arguments] { import(*arguments); });
}

}  // namespace mms
