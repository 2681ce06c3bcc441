#include "apps/mms/commands/calibration_options.hpp"
#include "apps/mms/commands/commands.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/mms/commands/run_session.hpp"
#include "apps/mms/commands/topic_options.hpp"
#include "apps/mms/console/common_options.hpp"
#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/viewing.hpp"
#include "mms/dataset/camera/camera_source.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

/// The argument of `--view` is a port, or DATA if that is not given elsewhere.
ViewOptions view_of(const CLI::App& command, const ViewChoice& view, RunOptions& options) {
  const std::string& word = view.word;
  ViewOptions place = view.place;
  if (word.empty()) return place;
  const std::optional<std::int64_t> port = parse_integer(word);
  if (!port && command.count("DATA") == 0) {
    options.data = word;
    return place;
  }
  place.port = checked_port("--view", word);
  return place;
}

void reject_for_camera(bool given, const char* option) {
  if (given) throw CLI::ValidationError(option, "is for recordings, not for cameras");
}

void run_camera(const RunOptions& options, const ConsoleOptions& console,
                const std::filesystem::path& record) {
  reject_for_camera(!options.masks.empty() || options.segmenter == "masks", "--masks");
  reject_for_camera(!options.topics.empty(), "--topic-*");
  reject_for_camera(options.rate.has_value(), "--rate");
  reject_for_camera(!options.motion.wheels.empty() || !options.motion.imu.empty(),
                    "--wheels, --imu");
  const InterruptGuard interrupt;
  // The camera counts those that are skipped at the start. In real time, the run leaves out those
  // that arrived before it.
  const std::size_t frames =
      options.realtime || options.frames > FrameSource::kEndless - options.start
          ? FrameSource::kEndless
          : options.frames + options.start;
  auto camera = std::make_unique<CameraSource>(
      options.data, LiveCameraOptions{.calibration = options.camera,
                                      .record = record,
                                      .frames = frames,
                                      .stop = [] { return InterruptGuard::requested(); }});
  if (!run_live(options, console, std::move(camera))) {
    throw DataError(options.data, "ended before its first frame");
  }
}

}  // namespace

void add_run_command(CLI::App& app) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      app.add_subcommand("run", "Localize a recording or a live camera, and map its surroundings");
  command
      ->add_option("DATA", options->data,
                   "recording (folder, .bag, .mcap, .db3, .pcap or .oni), a camera: "
                   "camera:openni2[:URI] or camera:v4l2[:URI], or a simulation: "
                   "sim:warehouse_loop[?seed=N&frames=N]")
      ->capture_default_str();
  const auto sequence = std::make_shared<std::string>();
  add_sequence_option(*command, *sequence);
  add_result_options(*command, *options);
  command
      ->add_option("--segmenter", options->segmenter,
                   "source of the masks of people and vehicles: a network, the recording's masks/ "
                   "(or --masks), or none")
      ->check(CLI::IsMember({"network", "masks", "none"}))
      ->default_str("network, or masks with --masks");
  command->add_option(
      "--weights", options->weights,
      "network instead of that of the settings: everyday, nano, our safetensors, or "
      "an ONNX model with YOLO-seg outputs");
  command->add_option("--masks", options->masks, "folder of label images, named as the frames");
  add_mapping_options(*command, *options);
  add_frames_option(*command, options->frames, "process at most N frames");
  command->add_option("--start", options->start, "skip the first K frames")
      ->check(CLI::Range(std::size_t{0}, kMaxFrames))
      ->capture_default_str();
  command->add_flag_callback(
      "--no-map-truth", [=] { options->map_truth = false; },
      "do not compare map and objects with the ground truth, which grows with the frames of a "
      "simulation");
  command->add_flag("--realtime", options->realtime, "play in real time and drop late frames");
  const auto record = std::make_shared<std::filesystem::path>();
  command->add_option("--record", *record, "record the camera to this folder, which mms run reads")
      ->type_name("DIR");
  add_recording_options(*command, *options);
  add_calibration_options(*command, options->camera);
  add_rate_option(*command, options->rate);
  add_topic_options(*command, options->topics);
  add_motion_options(*command, options->motion);
  const auto console = std::make_shared<ConsoleOptions>();
  const auto view = std::make_shared<ViewChoice>();
  add_console_options(*command, *console, *view);
  command->callback([=] {
    if (command->count("--view") > 0) options->view = view_of(*command, *view, *options);
    options->data = with_sequence(options->data, *sequence);
    if (options->segmenter.empty())
      options->segmenter = options->masks.empty() ? "network" : "masks";
    if (!options->weights.empty() && options->segmenter != "network") {
      throw CLI::ValidationError(
          "--weights", "is for masks of the network, but they come from " + options->segmenter);
    }
    if (is_camera_address(options->data)) return run_camera(*options, *console, *record);
    if (!record->empty()) {
      throw CLI::ValidationError("--record", "is for cameras, " + options->data +
                                                 " is none; mms convert copies recordings");
    }
    SlamRun run(*options);
    play_and_write(run, *console);
  });
}

}  // namespace mms
