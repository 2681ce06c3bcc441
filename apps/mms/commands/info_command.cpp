#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "apps/mms/commands/calibration_options.hpp"
#include "apps/mms/commands/map_command.hpp"
#include "apps/mms/commands/topic_options.hpp"
#include "apps/mms/console/common_options.hpp"
#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/plausibility/recording_check.hpp"
#include "mms/dataset/simulated/simulated_source.hpp"
#include "mms/geometry/noise_measurement.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/map_file/map_file.hpp"
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
  std::optional<double> rate;
  MotionOptions motion;
  bool json = false;

  std::unique_ptr<FrameSource> open() const {
    return open_dataset(
        data, {.masks = masks, .topics = topics, .camera = camera, .rate = rate, .motion = motion});
  }
};

/// What is known of a recording and what was checked in it.
struct RecordingInfo {
  std::vector<std::string> facts;  ///< "name: text" each
  std::vector<std::string> warnings;
  std::size_t frames = 0;
  std::map<std::size_t, std::string> frame_faults;  ///< of the frames that were read, or empty
  std::size_t plausibility_frames = 0;              ///< that were checked for it
  std::vector<std::string> implausible;
};

/// Reads the first frame, one at half and the last one of a newly opened recording.
void check_frames(FrameSource& source, RecordingInfo& info) {
  std::vector<std::string> warnings;
  source.on_warning([&](const std::string& message) { warnings.push_back(message); });
  std::size_t position = 0;
  std::size_t first = 0;  // of the last reading; each frame that is skipped gives a warning
  for (const std::size_t index : std::set<std::size_t>{0, info.frames / 2, info.frames - 1}) {
    if (index >= position) {
      warnings.clear();  // those of opening are in info_of
      first = index;
      source.skip(index - position);
      const auto frame = source.next();  // or the next one that can be read
      position = (frame ? static_cast<std::size_t>(frame->index) : info.frames) + 1;
    }
    const bool read = position == index + 1 || warnings.empty();
    info.frame_faults[index] = read ? "" : warnings[std::min(index - first, warnings.size() - 1)];
  }
}

void add_noise(const Image<float>& depth, RecordingInfo& info) {
  const double ratio = measured_noise({}, depth).base / DepthNoise{}.base;
  if (ratio > 1.0) {
    info.facts.push_back(
        fmt::format("depth noise: {:.1f} times the default, raised in runs", ratio));
  }
}

/// Reads frames spread over the recording, and a sequence from its center.
void check_plausibility(const InfoOptions& options, RecordingInfo& info) {
  const std::size_t first = (info.frames - std::min(info.frames, RecordingCheck::kSequence)) / 2;
  std::set<std::size_t> spread;
  for (std::size_t i = 0; i < RecordingCheck::kFrames; ++i) {
    spread.insert(i * info.frames / RecordingCheck::kFrames);
  }
  std::set<std::size_t> indices = spread;
  for (std::size_t i = 0; i < RecordingCheck::kSequence; ++i) indices.insert(first + i);
  RecordingCheck check;
  const auto source = options.open();
  std::size_t position = 0;
  for (const std::size_t index : indices) {
    if (index < position) continue;  // after frames that cannot be read
    source->skip(index - position);
    const auto frame = source->next();
    if (!frame) break;
    position = static_cast<std::size_t>(frame->index) + 1;
    if (index == 0) add_noise(frame->depth, info);
    if (spread.contains(index)) check.add(*frame);
    if (index >= first && index < first + RecordingCheck::kSequence) check.add_in_sequence(*frame);
  }
  info.implausible = check.faults();
  info.plausibility_frames = check.frames();
}

RecordingInfo info_of(const InfoOptions& options) {
  RecordingInfo info;
  const auto source = options.open();
  info.facts = source->describe();
  source->on_warning([&](const std::string& message) { info.warnings.push_back(message); });
  info.frames = source->size();
  if (info.frames == 0) return info;
  check_frames(*source, info);
  if (!is_simulated(options.data)) check_plausibility(options, info);
  return info;
}

void print_text(const RecordingInfo& info) {
  for (const std::string& fact : info.facts) fmt::print("{}\n", fact);
  for (const std::string& warning : info.warnings) fmt::print("warning: {}\n", warning);
  for (const auto& [index, fault] : info.frame_faults) {
    fmt::print("frame {}: {}\n", index, fault.empty() ? "readable" : fault);
  }
  for (const std::string& fault : info.implausible) fmt::print("implausible: {}\n", fault);
  if (info.implausible.empty() && info.plausibility_frames > 0) {
    fmt::print("plausible: {} frames checked\n", info.plausibility_frames);
  }
}

void print_json(const std::string& data, const RecordingInfo& info) {
  nlohmann::ordered_json facts = nlohmann::ordered_json::object();
  for (const std::string& fact : info.facts) {
    const std::size_t colon = fact.find(": ");
    const std::string name = fact.substr(0, colon);
    const std::string text = colon == std::string::npos ? "" : fact.substr(colon + 2);
    facts[name].push_back(text);  // a name may occur several times, as "topic"
  }
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (const auto& [index, fault] : info.frame_faults) {
    frames.push_back({{"index", index}, {"readable", fault.empty()}, {"fault", fault}});
  }
  const nlohmann::ordered_json json = {{"data", data},
                                       {"frames", info.frames},
                                       {"facts", facts},
                                       {"warnings", info.warnings},
                                       {"checked_frames", frames},
                                       {"plausibility_frames", info.plausibility_frames},
                                       {"implausible", info.implausible}};
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
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
  if (options.data.ends_with(".safetensors")) {
    if (options.json) {
      throw DataError(options.data, "is a weights file", "--json is for recordings and maps");
    }
    return print_model(options.data);
  }
  if (is_map_file(options.data)) return print_map_info(options.data, options.json);
  const RecordingInfo info = info_of(options);
  options.json ? print_json(options.data, info) : print_text(info);
}

}  // namespace

void add_info_command(CLI::App& app) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* command =
      app.add_subcommand("info", "Show the content of a recording, a map or a weights file");
  command
      ->add_option(
          "DATA", options->data,
          "recording (folder, .bag, .mcap or .db3), sim:SCENE, map, or weights.safetensors")
      ->required();
  const auto sequence = std::make_shared<std::string>();
  add_sequence_option(*command, *sequence);
  command->add_option("--masks", options->masks, "folder of label images, named as the frames");
  command->add_flag("--json", options->json, "print one JSON object");
  add_calibration_options(*command, options->camera);
  add_rate_option(*command, options->rate);
  add_topic_options(*command, options->topics);
  add_motion_options(*command, options->motion);
  command->callback([options, sequence] {
    options->data = with_sequence(options->data, *sequence);
    print_info(*options);
  });
}

}  // namespace mms
