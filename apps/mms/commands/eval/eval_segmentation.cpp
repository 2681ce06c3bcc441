#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "apps/mms/commands/eval/eval_parts.hpp"
#include "mms/evaluation/segmentation/segmentation_error.hpp"

namespace mms {
namespace {

struct SegmentationArguments {
  std::string truth;
  std::string results;
  std::string category;
  std::string split;
  bool json = false;
};

void evaluate(const SegmentationArguments& arguments) {
  const CocoDataset truth = read_coco(arguments.truth);
  const std::vector<CocoResult> results = read_coco_results(arguments.results);
  const SegmentationErrors errors = segmentation_error(truth, results,
                                                       {.category = arguments.category,
                                                        .split = arguments.split,
                                                        .truth_name = arguments.truth,
                                                        .results_name = arguments.results});
  if (arguments.json) {
    fmt::print("{}\n", to_json(errors));
    return;
  }
  fmt::print("{} images with {} objects; {} of {} results belong to these images and classes\n",
             errors.images, errors.objects, errors.results, results.size());
  fmt::print("{}", to_table(errors));
}

}  // namespace

void add_eval_segmentation(CLI::App& eval) {
  const auto arguments = std::make_shared<SegmentationArguments>();
  CLI::App* command =
      eval.add_subcommand("segmentation", "COCO average precision and recall of masks");
  command->add_option("COCO_GT", arguments->truth, "ground truth, COCO annotations")->required();
  command->add_option("COCO_RESULTS", arguments->results, "detections, COCO results")->required();
  command->add_option("--category", arguments->category, "evaluate only this class");
  command->add_option("--split", arguments->split,
                      "evaluate only the images of this split, such as \"holdout\"");
  add_json_flag(*command, arguments->json);
  command->callback([arguments] { evaluate(*arguments); });
}

}  // namespace mms
