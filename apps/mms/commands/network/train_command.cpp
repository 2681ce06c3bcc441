#include <fmt/core.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/mms/commands/commands.hpp"
#include "apps/mms/console/common_options.hpp"
#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/thread_limit.hpp"
#include "apps/mms/console/training_progress.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/core/error.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/training/run/training_run.hpp"

namespace mms {
namespace {

struct TrainArguments {
  std::filesystem::path config;
  std::filesystem::path output;
  int threads = 0;  ///< 0: one per core
};

/// Each step allocates the same tensors again. To return their memory to the system in between took
/// half of the time of a step.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kNever = -1;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, kNever);
#endif
}

void train(const TrainArguments& arguments) {
  keep_freed_memory();
  TrainingConfig config;
  print_warnings(load_config(arguments.config, config));
  const ThreadLimit limit(arguments.threads);
  const InterruptGuard interrupt;
  TrainingProgress progress;
  const ProcessPlace place = process_place();
  if (place.size > 1) {
    fmt::print(stderr, "waiting for all of {} processes at {}:{}\n", place.size, place.address,
               place.port);
  }
  std::optional<TrainingRun> begun;
  try {
    begun.emplace(config, arguments.output, arguments.threads, place, InterruptGuard::requested);
  } catch (const Error&) {
    if (!InterruptGuard::requested()) throw;
    throw Interrupted("not all processes have started, nothing was trained");
  }
  TrainingRun& run = *begun;
  run.on_event([&](const TrainingEvent& event) {
    if (run.is_first()) progress.show(event);
    return !InterruptGuard::requested();
  });
  const bool finished = run.train();
  progress.finish();
  if (!finished) throw Interrupted("the same command continues from the last checkpoint");
  if (!run.is_first()) return;
  fmt::print("weights: {}\nreport:  {}\n", run.weights_path().string(), run.report_path().string());
}

}  // namespace

void add_train_command(CLI::App& app) {
  const auto arguments = std::make_shared<TrainArguments>();
  CLI::App* command = app.add_subcommand("train", "Train the segmentation network");
  command->footer("Several processes divide each batch, if torchrun or srun starts them.");
  command
      ->add_option("-c,--config", arguments->config,
                   "architecture, data and schedule (examples: config/train/*.yaml)")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "folder for weights, checkpoints and report; an existing training is continued")
      ->required();
  add_threads_option(*command, arguments->threads);
  command->callback([arguments] { train(*arguments); });
}

}  // namespace mms
