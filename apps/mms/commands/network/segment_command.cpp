#include "apps/mms/commands/calibration_options.hpp"
#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/mms/commands/network/detection_picture.hpp"
#include "apps/mms/commands/network/picture_source.hpp"
#include "apps/mms/console/common_options.hpp"
#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/rate_progress.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/core/error.hpp"
#include "mms/io/config/config_assignments.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/image/coco_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/output_folder.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/run/record/peak_memory.hpp"
#include "mms/run/segmenter/network_detector.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxImages = 1'000'000'000;  // number of images

struct SegmentArguments {
  std::string data;
  fs::path output;
  fs::path config;
  fs::path weights;
  fs::path annotations;
  std::string split;
  std::size_t limit = kMaxImages;
  int threads = 0;
  bool json_only = false;
  bool overwrite = false;
  CameraOptions camera;
  std::vector<std::string> set;
};

constexpr std::string_view kOutputs[] = {"masks", "overlays", "results.json", "images.json"};
constexpr std::string_view kMarks[] = {"results.json", "images.json"};

SegmentationConfig settings_of(const SegmentArguments& arguments) {
  SystemConfig config;
  config.segmentation.threads = 0;  // one per core
  if (!arguments.config.empty()) print_warnings(load_config(arguments.config, config));
  print_warnings(assign(config, arguments.set, "--set"));
  if (!arguments.weights.empty()) config.segmentation.weights = arguments.weights.string();
  if (arguments.threads > 0) config.segmentation.threads = arguments.threads;
  return config.segmentation;
}

/// The network's classes with the ids of equal names in `known`, else unused ones.
std::vector<CocoCategory> categories_of(const std::vector<std::string>& classes,
                                        const std::vector<CocoCategory>& known) {
  int next = 1;
  for (const CocoCategory& one : known) next = std::max(next, one.id + 1);
  std::vector<CocoCategory> categories;
  for (const std::string& name : classes) {
    const auto found = std::ranges::find(known, name, &CocoCategory::name);
    categories.push_back({found != known.end() ? found->id : next++, name});
  }
  return categories;
}

/// Writes masks, overlays and results, image by image.
class SegmentOutputs {
 public:
  SegmentOutputs(const fs::path& folder, std::vector<std::string> classes,
                 const std::vector<CocoCategory>& known, double least_score, bool json_only,
                 bool overwrite)
      : folder_(folder),
        lock_(folder),
        classes_(std::move(classes)),
        least_score_(least_score),
        json_only_(json_only) {
    take_output_folder(folder_, kOutputs, kMarks, overwrite);
    results_.emplace(folder_ / "results.json");
    if (!json_only_) make_folder(folder_ / "masks");
    if (!json_only_) make_folder(folder_ / "overlays");
    found_.categories = categories_of(classes_, known);
  }

  void add(const Picture& picture, std::vector<Detection> detections) {
    const int width = picture.image.width();
    const int height = picture.image.height();
    found_.images.push_back(
        {.id = picture.id, .file_name = picture.name, .width = width, .height = height});
    for (const Detection& d : detections) {
      results_->add({picture.id, found_.categories[static_cast<std::size_t>(d.category)].id,
                     d.score, encode_rle(d.mask, d.x, d.y, width, height)});
    }
    std::erase_if(detections, [&](const Detection& d) { return d.score < least_score_; });
    objects_ += detections.size();
    if (json_only_) return;
    write_png(folder_ / "masks" / (picture.stem + ".png"),
              label_image(width, height, detections, classes_));
    write_file(folder_ / "overlays" / (picture.stem + ".jpg"),
               encode_jpeg(draw_detections(picture.image, detections, classes_)));
  }

  void finish() {
    results_->finish();
    write_coco(folder_ / "images.json", found_);
  }

  std::size_t pictures() const { return found_.images.size(); }
  std::size_t objects() const { return objects_; }

 private:
  fs::path folder_;
  FolderLock lock_;
  std::vector<std::string> classes_;
  double least_score_;
  bool json_only_;
  CocoDataset found_;                         ///< images and categories
  std::optional<CocoResultsWriter> results_;  ///< opened after the folder was created
  std::size_t objects_ = 0;
};

/// Mean time per image. The first one, which includes the warm-up of the network, is reported
/// separately.
class PictureTimes {
 public:
  void add(std::chrono::duration<double, std::milli> time) {
    (pictures_ == 0 ? first_ : rest_) += time.count();
    ++pictures_;
  }

  std::string text() const {
    if (pictures_ < 2) return fmt::format("{:.1f} ms/image", first_);
    return fmt::format("{:.1f} ms/image (the first {:.0f})", rest_ / (pictures_ - 1), first_);
  }

 private:
  int pictures_ = 0;
  double first_ = 0.0;
  double rest_ = 0.0;
};

std::unique_ptr<PictureSource> open_source(const SegmentArguments& arguments,
                                           const PictureWarning& warning) {
  if (arguments.annotations.empty())
    return open_pictures(arguments.data, warning, arguments.camera);
  return open_annotated(arguments.annotations, arguments.data, arguments.split, warning);
}

void segment(const SegmentArguments& arguments) {
  const SegmentationConfig config = settings_of(arguments);
  RateProgress progress("picture");
  const auto source =
      open_source(arguments, [&](const std::string& message) { progress.warn(message); });
  const std::unique_ptr<Detector> detector = make_detector(config);
  const InterruptGuard interrupt;
  SegmentOutputs outputs(arguments.output, detector->classes(), source->categories(),
                         config.objects.score, arguments.json_only, arguments.overwrite);
  const auto total = static_cast<int>(std::min(source->size(), arguments.limit));
  PictureTimes times;
  while (outputs.pictures() < arguments.limit && !InterruptGuard::requested()) {
    const std::optional<Picture> picture = source->next();
    if (!picture) break;
    const auto start = std::chrono::steady_clock::now();
    std::vector<Detection> detections = detector->detect(picture->image);
    times.add(std::chrono::steady_clock::now() - start);
    outputs.add(*picture, std::move(detections));
    progress.show(static_cast<int>(outputs.pictures()), total);
  }
  progress.finish();
  if (outputs.pictures() == 0) {
    if (InterruptGuard::requested()) throw Interrupted("no image is segmented");
    throw DataError(arguments.data, "none of its images could be read", "see the warnings above");
  }
  outputs.finish();
  fmt::print("{}: {} images, {} objects with score {} or more, {}, {:.0f} MB\n",
             arguments.output.string(), outputs.pictures(), outputs.objects(), config.objects.score,
             times.text(), peak_memory_mb());
  if (InterruptGuard::requested()) {
    throw Interrupted(fmt::format("{} of {} images are segmented", outputs.pictures(), total));
  }
}

}  // namespace

void add_segment_command(CLI::App& app) {
  const auto arguments = std::make_shared<SegmentArguments>();
  CLI::App* command = app.add_subcommand("segment", "Segment people and vehicles in images");
  command
      ->add_option("DATA", arguments->data,
                   "an image, a folder of images, or a recording as for mms run")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "output folder for masks/, overlays/, results.json (COCO) and images.json")
      ->required();
  command->add_option("-c,--config", arguments->config,
                      "settings file, of which the group 'segmentation' is used");
  add_set_option(*command, arguments->set);
  command->add_flag("--overwrite", arguments->overwrite,
                    "replace the results of an earlier call in this folder");
  command->add_option("--weights", arguments->weights,
                      "network: everyday, nano, our safetensors, or an ONNX model with YOLO-seg "
                      "outputs");
  CLI::Option* annotations =
      command->add_option("--annotations", arguments->annotations,
                          "COCO file: segment its images, which are below DATA, with their ids");
  command->add_option("--split", arguments->split, "segment only images of this split")
      ->needs(annotations);
  command->add_option("--limit", arguments->limit, "segment at most N images")
      ->check(CLI::Range(std::size_t{1}, kMaxImages))
      ->default_str("all");
  add_threads_option(*command, arguments->threads,
                     "threads of the network (default: one per core)");
  command->add_flag("--json-only", arguments->json_only, "write no masks and overlays");
  add_calibration_options(*command, arguments->camera);
  command->callback([arguments] { segment(*arguments); });
}

}  // namespace mms
