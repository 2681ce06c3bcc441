#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "apps/mms/commands/calibration_options.hpp"
#include "apps/mms/commands/topic_options.hpp"
#include "apps/mms/console/common_options.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/plausibility/recording_check.hpp"
#include "mms/dataset/simulated/simulated_source.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/segmentation/solo/prepared_image.hpp"
#include "mms/segmentation/weights/model.hpp"
#include "mms/segmentation/weights/operation_count.hpp"

namespace mms {
namespace {

struct InfoOptions {
  std::string data;
  std::string masks;
  BagTopicNames topics;
  CameraOptions camera;

  std::unique_ptr<FrameSource> open() const {
    return open_dataset(data, {.masks = masks, .topics = topics, .camera = camera});
  }
};

/// Reads one frame of a newly opened recording.
/// @returns the fault; empty if none
std::string fault_of_frame(const InfoOptions& options, std::size_t index) {
  const auto source = options.open();
  std::vector<std::string> warnings;
  source->on_warning([&](const std::string& message) { warnings.push_back(message); });
  warnings.clear();  // those of opening are shown by print_info
  source->skip(index);
  const auto frame = source->next();
  const bool read = frame && frame->index == static_cast<std::int64_t>(index);
  return read || warnings.empty() ? "" : warnings.front();
}

void print_frame_checks(const InfoOptions& options, std::size_t size) {
  const std::set<std::size_t> checked = {0, size / 2, size - 1};
  for (const std::size_t index : checked) {
    const std::string fault = fault_of_frame(options, index);
    fmt::print("frame {}: {}\n", index, fault.empty() ? "readable" : fault);
  }
}

/// Reads frames spread over the recording and prints what is implausible in them.
void print_plausibility(const InfoOptions& options, std::size_t size) {
  RecordingCheck check;
  const auto source = options.open();
  const std::size_t step = std::max<std::size_t>(1, size / RecordingCheck::kFrames);
  for (std::size_t i = 0; i < RecordingCheck::kFrames; ++i) {
    const auto frame = source->next();
    if (!frame) break;
    check.add(*frame);
    source->skip(step - 1);
  }
  const std::vector<std::string> faults = check.faults();
  for (const std::string& fault : faults) fmt::print("implausible: {}\n", fault);
  if (faults.empty() && check.frames() > 0)
    fmt::print("plausible: {} frames checked\n", check.frames());
}

/// Prints architecture and cost of a weights file.
void print_model(const std::string& path) {
  SegmentationModel model = unpack_model(read_safetensors(path), path);
  const NetworkConfig& network = model.network;
  std::string names;
  for (const std::string& name : model.classes) names += (names.empty() ? "" : ", ") + name;
  const PreparedImage input = prepare_image(Image<Rgb>(640, 480), network);
  fmt::print("segmentation network of the classes {}\n", names);
  fmt::print("{:.2f} million parameters\n",
             1e-6 * static_cast<double>(network_parameters(network)));
  fmt::print("{:.2f} GFLOP for an image of 640x480 (input {}x{})\n",
             1e-9 * static_cast<double>(network_operations(network, input.width, input.height)),
             input.width, input.height);
  fmt::print("{}", dump_config(network));
}

void print_info(const InfoOptions& options) {
  if (options.data.ends_with(".safetensors")) return print_model(options.data);
  const auto source = options.open();
  for (const std::string& line : source->describe()) fmt::print("{}\n", line);
  source->on_warning([](const std::string& message) { fmt::print("warning: {}\n", message); });
  if (source->size() == 0) return;
  print_frame_checks(options, source->size());
  if (!is_simulated(options.data)) print_plausibility(options, source->size());
}

}  // namespace

void add_info_command(CLI::App& app) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* command =
      app.add_subcommand("info", "Show the content of a recording or a weights file");
  command
      ->add_option("DATA", options->data,
                   "folder of the recording, x.bag, sim:SCENE, or weights.safetensors")
      ->required();
  const auto sequence = std::make_shared<std::string>();
  add_sequence_option(*command, *sequence);
  command->add_option("--masks", options->masks, "folder of label images, named as the frames");
  add_calibration_options(*command, options->camera);
  add_topic_options(*command, options->topics);
  command->callback([options, sequence] {
    options->data = with_sequence(options->data, *sequence);
    print_info(*options);
  });
}

}  // namespace mms
