#include "apps/mms/commands/training_set_command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "apps/mms/console/common_options.hpp"
#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/rate_progress.hpp"
#include "apps/mms/console/thread_limit.hpp"
#include "mms/dataset/simulated/training_set.hpp"

namespace mms {
namespace {

constexpr int kMaxTrainingImages = 1'000'000;  // file names have six digits

struct TrainingSetArguments {
  std::filesystem::path output;
  int images = 0;
  int seed = 1;
  int threads = 0;  ///< 0: one per core
};

void write_set(const TrainingSetArguments& arguments) {
  const ThreadLimit limit(arguments.threads);
  const InterruptGuard interrupt;
  RateProgress progress("image");
  TrainingSetOptions options;
  options.images = arguments.images;
  options.seed = static_cast<std::uint64_t>(arguments.seed);
  options.progress = [&](int done, int fresh) {
    progress.show(done, arguments.images, fresh);
    return !InterruptGuard::requested();
  };
  const WrittenTrainingSet written = write_training_set(arguments.output, options);
  progress.finish();
  fmt::print(
      "{}: {} images, {} of them rendered by this call; {} objects in annotations.json, {} of them "
      "marked as crowd\n",
      arguments.output.string(), written.images, written.fresh, written.annotations, written.crowd);
  if (written.images < arguments.images) {
    throw Interrupted(fmt::format("the same command continues with image {}", written.images));
  }
}

}  // namespace

void add_training_set_command(CLI::App& simulate) {
  const auto arguments = std::make_shared<TrainingSetArguments>();
  CLI::App* command = simulate.add_subcommand(
      "training-set", "Render single images with COCO annotations for training a network");
  command
      ->add_option("-o,--output", arguments->output,
                   "folder of the set; an unfinished one is continued")
      ->required();
  command->add_option("--images", arguments->images, "number of images of the whole set")
      ->check(CLI::Range(1, kMaxTrainingImages))
      ->required();
  command->add_option("--seed", arguments->seed, "seed of all random numbers")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  add_threads_option(*command, arguments->threads);
  command->callback([arguments] { write_set(*arguments); });
}

}  // namespace mms
