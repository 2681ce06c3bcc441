#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "apps/mms/commands/live/ros2_map_saver.hpp"
#include "apps/mms/commands/live/ros2_restart.hpp"
#include "apps/mms/commands/run_session.hpp"
#include "apps/mms/console/common_options.hpp"
#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/viewing.hpp"
#include "mms/core/error.hpp"
#include "mms/dataset/bag/bag_topics.hpp"
#include "mms/ros2/ros2_parameters.hpp"
#include "mms/ros2/ros2_results.hpp"
#include "mms/ros2/ros2_source.hpp"
#include "mms/run/sensor_settings.hpp"

namespace mms {
namespace {

struct Ros2CommandOptions {
  Ros2NodeOptions node;
  Ros2Inputs inputs;
  bool depth_registered = false;
  Ros2ResultOptions results;
  std::size_t queue = 10;
  std::filesystem::path save_folder = ".";
  RunOptions run;
  ConsoleOptions console;
  ViewChoice view;
};

#ifdef MMS_WITH_ROS2

/// Publishes diagnostics once a second, and warns where nothing arrives.
void add_diagnosis(Ros2Node& node, Ros2Source& source, Ros2Results& results) {
  constexpr double kPeriod = 1.0;  // [s]
  constexpr int kRepeat = 5;       // periods without frames between warnings
  node.every(kPeriod, [&source, &results, seen = std::size_t{0}, idle = 0]() mutable {
    const Ros2InputCounts counts = source.counts();
    const std::string inputs = source.report();
    idle = counts.frames > std::exchange(seen, counts.frames) ? 0 : idle + 1;
    if (idle > 0 && idle % kRepeat == 0) source.warn("no frames arrive: " + inputs);
    results.diagnose(inputs, counts);
  });
}

/// A node with one run.
/// @returns the options of the next one, if the services ask for it
std::optional<RunOptions> run_once(const Ros2CommandOptions& options, const RunOptions& run) {
  std::vector<std::string> warnings;  // the run has them again
  const SystemConfig config =
      with_options(sensor_settings(nullptr, run.config, run.set, "--set", warnings), run);
  Ros2Source* source = nullptr;  // set before the node starts
  Ros2Node node(options.node,
                [&source](const std::string& fault) { source->count_damaged(fault); });
  Ros2Results results(node, options.results);
  Ros2Restart restart(config.global_map.enabled,
                      [&source](const std::string& message) { source->warn(message); });
  auto owned = std::make_unique<Ros2Source>(
      node, options.inputs, options.queue,
      [&restart] { return InterruptGuard::requested() || restart.is_requested(); },
      [&restart, &source] {
        if (restart.reset().success) source->warn("the clock went back: another run begins");
      });
  source = owned.get();
  node.serve("~/reset", [&restart](const Ros2Node::Reply& reply) { reply(restart.reset()); });
  node.answer<msg::LoadMapRequest, msg::LoadMapReply>(
      "~/load_map", "nav2_msgs/LoadMap",
      [&restart](const msg::LoadMapRequest& request) { return restart.load(request.map_url); });
  Ros2MapSaver saver(options.save_folder, source->is_camera());
  node.serve("~/save_map", [&saver](const Ros2Node::Reply& reply) { saver.request(reply); });
  node.every(1.0, [&saver] { saver.refuse_late(); });
  offer_parameters(node, config);
  add_diagnosis(node, *source, results);
  node.start();
  if (!options.console.quiet) {
    fmt::print(stderr, "node {} in domain {} waits for frames\n", node.full_name(), node.domain());
  }
  ConsoleOptions console = options.console;
  console.continues = [&restart] { return restart.is_requested(); };
  const bool had_frames = run_live(
      run, console, std::move(owned), [&](const Processed& processed, const SlamSystem& system) {
        results.publish(processed, system, source->sensor_frame(), source->is_camera());
        saver.add(processed, system);
      });
  if (restart.is_requested() && !InterruptGuard::requested()) return restart.next(options.run);
  if (!had_frames) throw DataError(run.data, "ended before its first frame");
  return std::nullopt;
}

void run_node(const Ros2CommandOptions& options) {
  const InterruptGuard interrupt;
  std::optional<RunOptions> run = options.run;
  while (run) run = run_once(options, *run);
}

#else

void run_node(const Ros2CommandOptions&) {
  throw DataError("mms ros2", "is not part of this build",
                  "install cyclonedds-dev, then configure and build again");
}

#endif

void add_input_options(CLI::App& command, Ros2Inputs& inputs, bool& depth_registered) {
  const auto add = [&](const char* name, std::string& topic, const char* help) {
    return command.add_option(name, topic, help)
        ->group("Topics of the sensors")
        ->type_name("TOPIC");
  };
  add("--color", inputs.color,
      "color images, Image; CompressedImage where the name ends with /compressed")
      ->default_str("/camera/color/image_raw; none with --points");
  add("--depth", inputs.depth, "depth images, Image; CompressedImage: .../compressedDepth")
      ->default_str("/camera/aligned_depth_to_color/image_raw");
  add("--camera-info", inputs.camera_info, "CameraInfo of the color images")
      ->default_str("camera_info beside --color");
  add("--depth-info", inputs.depth_info,
      "CameraInfo of depth images with a frame of their own: they are registered by it and /tf")
      ->default_str("camera_info beside --depth");
  command
      .add_flag("--depth-registered", depth_registered,
                "depth images are registered to the color images; so are those whose names have "
                "aligned, registered, to_color or to_rgb")
      ->group("Topics of the sensors")
      ->excludes("--depth-info");
  add("--points", inputs.points, "LiDAR scans in place of depth images, PointCloud2");
  add("--imu", inputs.imu, "gyroscope, Imu");
  add("--odometry", inputs.wheels, "wheel odometry, Odometry");
  add("--mask", inputs.mask, "label images: 0 static, 1 person, 2 vehicle");
  add("--tf", inputs.transforms,
      "transforms, TFMessage; the static ones on the same name with _static. Of robots with a "
      "namespace: tf")
      ->capture_default_str();
  add("--initial-pose", inputs.initial_pose,
      "initial pose of the sensor in the map, as from RViz, PoseWithCovarianceStamped")
      ->capture_default_str();
}

void add_node_options(CLI::App& command, Ros2CommandOptions& options) {
  const auto group = [](CLI::Option* option) { return option->group("Node"); };
  group(command.add_option("--node-name", options.node.name, "name of the node"))
      ->capture_default_str();
  group(command.add_option("--namespace", options.node.name_space, "namespace of the node"))
      ->capture_default_str();
  group(command.add_option("--ros-distro", options.node.distro,
                           "distribution of the other nodes (default: ROS_DISTRO, or jazzy): "
                           "Humble has another discovery"))
      ->check(CLI::IsMember({"humble", "iron", "jazzy", "kilted", "lyrical", "rolling"}));
  group(command.add_option("--map-frame", options.results.map_frame, "frame with z up"))
      ->capture_default_str();
  group(command.add_option("--world-frame", options.results.world_frame,
                           "frame of the results: the first sensor frame"))
      ->capture_default_str();
  group(command.add_option("--map-period", options.results.map_period, "period of ~/map [s]"))
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  group(command.add_flag("!--no-tf", options.results.transforms, "publish no transforms"));
  group(command.add_option("--queue", options.queue,
                           "frames that may wait; the oldest is dropped then"))
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  group(command.add_option("--save-folder", options.save_folder,
                           "where the service ~/save_map writes"))
      ->capture_default_str();
}

/// Fills in the topics that are not given.
void complete_inputs(Ros2Inputs& inputs, bool depth_registered, const std::string& segmenter) {
  if (inputs.points.empty()) {
    if (inputs.color.empty()) inputs.color = "/camera/color/image_raw";
    if (inputs.depth.empty()) inputs.depth = "/camera/aligned_depth_to_color/image_raw";
    const bool registered = depth_registered || is_named_registered(inputs.depth);
    if (inputs.depth_info.empty() && !registered) {
      inputs.depth_info = camera_info_beside(inputs.depth);
    }
  } else if (!inputs.depth.empty()) {
    throw CLI::ValidationError("--points", "is in place of --depth: give one of them");
  }
  if (inputs.camera_info.empty() && !inputs.color.empty()) {
    inputs.camera_info = camera_info_beside(inputs.color);
  }
  if (segmenter == "masks" && inputs.mask.empty()) {
    throw CLI::ValidationError("--segmenter", "is masks, so their topic is needed: --mask TOPIC");
  }
  if (segmenter != "masks") inputs.mask.clear();
}

}  // namespace

void add_ros2_command(CLI::App& app) {
  const auto options = std::make_shared<Ros2CommandOptions>();
  RunOptions& run = options->run;
  run.data = "ros2";
  CLI::App* command = app.add_subcommand("ros2", "Run as a ROS 2 node (needs no ROS installation)");
  add_input_options(*command, options->inputs, options->depth_registered);
  add_node_options(*command, *options);
  add_result_options(*command, run);
  command
      ->add_option("--segmenter", run.segmenter,
                   "source of the masks of people and vehicles: a network, the topic --mask, or "
                   "none")
      ->check(CLI::IsMember({"network", "masks", "none"}))
      ->default_str("network, or masks with --mask");
  command->add_option(
      "--weights", run.weights,
      "network instead of that of the settings: everyday, nano, our safetensors, or "
      "an ONNX model with YOLO-seg outputs");
  add_mapping_options(*command, run);
  add_frames_option(*command, run.frames, "end after N frames");
  command->add_flag("--realtime", run.realtime,
                    "keep the latency small: drop frames that find the pipeline busy");
  add_recording_options(*command, run);
  add_console_options(*command, options->console, options->view);
  command->callback([options, command] {
    RunOptions& run_options = options->run;
    if (run_options.segmenter.empty()) {
      run_options.segmenter = options->inputs.mask.empty() ? "network" : "masks";
    }
    if (!run_options.weights.empty() && run_options.segmenter != "network") {
      throw CLI::ValidationError(
          "--weights", "is for masks of the network, but they come from " + run_options.segmenter);
    }
    complete_inputs(options->inputs, options->depth_registered, run_options.segmenter);
    options->inputs.map_frame = options->results.map_frame;
    options->results.transforms_topic = options->inputs.transforms;
    if (command->count("--view") > 0) {
      run_options.view = options->view.place;
      if (!options->view.word.empty()) {
        run_options.view->port = checked_port("--view", options->view.word);
      }
    }
    // CLI11 would check a variable given by `envname` for every command.
    const char* distro = std::getenv("ROS_DISTRO");
    if (distro != nullptr && *distro != '\0' && command->count("--ros-distro") == 0) {
      options->node.distro = distro;
    }
    run_node(*options);
  });
}

}  // namespace mms
