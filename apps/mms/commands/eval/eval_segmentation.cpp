#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/mms/commands/eval/eval_parts.hpp"
#include "mms/evaluation/segmentation/pixel_scores.hpp"
#include "mms/evaluation/segmentation/segmentation_error.hpp"

namespace mms {
namespace {

struct SegmentationArguments {
  std::string truth;
  std::string results;
  std::string category;
  std::string split;
  double min_score = PixelScoreOptions().min_score;
  bool pixels = false;
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
  PixelScoreOptions options;
  if (!arguments.category.empty()) options.category = arguments.category;
  options.split = arguments.split;
  options.min_score = arguments.min_score;
  if (arguments.json) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(to_json(errors));
    if (arguments.pixels) {
      json["pixels"] =
          nlohmann::ordered_json::parse(to_json(pixel_scores(truth, results, options)));
    }
    fmt::print("{}\n", json.dump());
    return;
  }
  fmt::print("{} images with {} objects; {} of {} results belong to these images and classes\n",
             errors.images, errors.objects, errors.results, results.size());
  fmt::print("{}", to_table(errors));
  if (!arguments.pixels) return;
  fmt::print("\npixels of class {} under masks of score {:.2f} or more, by height in the image\n",
             options.category, options.min_score);
  fmt::print("{}", to_table(pixel_scores(truth, results, options)));
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
  CLI::Option* pixels =
      command->add_flag("--pixels", arguments->pixels,
                        "also recall and precision of the pixels, by the objects' height");
  command
      ->add_option("--min-score", arguments->min_score, "lowest score of a mask that counts there")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0))
      ->needs(pixels);
  add_json_flag(*command, arguments->json);
  command->callback([arguments] { evaluate(*arguments); });
}

}  // namespace mms
