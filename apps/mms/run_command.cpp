#include "run_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "mms/io/numbers.hpp"
#include "result_folder.hpp"
#include "run_options.hpp"
#include "run_outputs.hpp"
#include "slam_run.hpp"
#include "topic_options.hpp"

namespace mms {
namespace {

constexpr int kMaxCount = 1'000'000'000;  // of frames

void run(const RunOptions& options) {
  SlamRun run(options);
  const ResultFolder folder(options.output, options.data);
  run.play(folder.path());
  run.write(folder.path());
  folder.make_latest();
  print_summary(folder.path(), run.log());
  run.keep_showing(folder.path());
}

/// What `--view` has after it is a port, or DATA where that is not given elsewhere.
ViewOptions view_of(const CLI::App& command, const std::string& word, ViewOptions place,
                    RunOptions& options) {
  if (word.empty()) return place;
  const std::optional<std::int64_t> port = parse_integer(word);
  if (!port && command.count("DATA") == 0) {
    options.data = word;
    return place;
  }
  place.port = checked_port("--view", word);
  return place;
}

}  // namespace

void add_run_command(CLI::App& app) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "Localise a recording and map its surroundings");
  command
      ->add_option("DATA", options->data,
                   "recording (folder or .bag), or a simulation: "
                   "sim:warehouse_loop[?seed=N&frames=N]")
      ->capture_default_str();
  command->add_option("-c,--config", options->config, "settings (mms config dump prints them all)");
  command->add_option("-o,--output", options->output,
                      "folder for the results (default: results/<time>_<name>)");
  command
      ->add_option("--segmenter", options->segmenter,
                   "where masks of people and vehicles come from: a network, the recording's "
                   "masks/ (or --masks), or nowhere")
      ->check(CLI::IsMember({"network", "masks", "none"}))
      ->default_str("network, or masks with --masks");
  command->add_option("--weights", options->weights,
                      "network to use in place of the settings': a safetensors file of ours, or an "
                      "ONNX model with YOLO-seg's outputs");
  command->add_option("--masks", options->masks, "folder of label images named like the frames");
  command
      ->add_option("--fusion", options->fusion,
                   "what makes a point dynamic (default: as the settings say, multimodal)")
      ->check(CLI::IsMember({"multimodal", "vision", "none"}));
  command->add_option("--frames", options->frames, "process at most N frames")
      ->check(CLI::Range(1, kMaxCount))
      ->default_str("all");
  command->add_option("--start", options->start, "pass over the first K frames")
      ->check(CLI::Range(0, kMaxCount))
      ->capture_default_str();
  command->add_flag("--realtime", options->realtime,
                    "play at the recording's pace and drop frames that come too fast");
  command
      ->add_option("--threads", options->threads,
                   "threads to use (default: one a core); the results are the same for any number")
      ->check(CLI::Range(1, 256));
  command->add_flag("--keep-journal", options->keep_journal,
                    "leave journal.bin, from which mms convert recovers a run that was killed, in "
                    "the folder of a run that came to its end");
  add_topic_options(*command, options->topics);
  const auto view = std::make_shared<std::string>();
  const auto place = std::make_shared<ViewOptions>();
  command
      ->add_option("--view", *view,
                   "show the run in a browser while it goes on, at this port (8080)")
      ->expected(0, 1)
      ->type_name("[PORT]");
  add_bind_option(*command, *place);
  command->callback([=] {
    if (command->count("--view") > 0) options->view = view_of(*command, *view, *place, *options);
    if (options->segmenter.empty())
      options->segmenter = options->masks.empty() ? "network" : "masks";
    if (!options->weights.empty() && options->segmenter != "network") {
      throw CLI::ValidationError(
          "--weights", "is for masks of the network, but they come from " + options->segmenter);
    }
    run(*options);
  });
}

}  // namespace mms
