#include "apps/mms/commands/commands.hpp"
#include "apps/mms/console/overwrite_option.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "apps/mms/commands/network/picture_source.hpp"
#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/rate_progress.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/core/error.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/run/segmenter/network_detector.hpp"
#include "mms/segmentation/engine/calibration/range_calibration.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

struct QuantizeArguments {
  fs::path weights;
  fs::path output;
  std::vector<std::string> data;
  std::vector<std::string> float_layers;
  std::size_t images = 300;
  int long_side = 0;
  std::size_t judged = 8;
  bool int8_weights = false;
  bool sensitivity = false;
  bool overwrite = false;
};

void stop_if_asked() {
  if (InterruptGuard::requested()) {
    throw Error("mms quantize", "was interrupted", "nothing was written");
  }
}

/// Evenly spaced images of each source.
std::vector<PreparedImage> pictures_of(const QuantizeArguments& arguments,
                                       const NetworkConfig& config) {
  RateProgress progress("picture");
  std::vector<PreparedImage> pictures;
  for (const std::string& where : arguments.data) {
    const auto source =
        open_pictures(where, [&](const std::string& message) { progress.warn(message); });
    const std::size_t per_source =
        std::max<std::size_t>(1, arguments.images / arguments.data.size());
    const std::size_t size = std::max<std::size_t>(1, source->size());
    const std::size_t wanted = std::min({per_source, size, arguments.images - pictures.size()});
    std::size_t taken = 0;
    for (std::size_t i = 0; taken < wanted; ++i) {
      const std::optional<Picture> picture = source->next();
      if (!picture) break;
      stop_if_asked();
      if (i * wanted / size < taken) continue;  // the k-th image is at or after k size / wanted
      pictures.push_back(prepare_image(picture->image, config));
      ++taken;
    }
  }
  progress.finish();
  if (pictures.empty()) {
    throw DataError("--data", "has no readable image", "see the warnings above");
  }
  return pictures;
}

/// Evenly spaced subset for the sensitivity.
std::vector<PreparedImage> subset_of(const std::vector<PreparedImage>& pictures,
                                     std::size_t count) {
  std::vector<PreparedImage> some;
  const std::size_t every = std::max<std::size_t>(1, pictures.size() / count);
  for (std::size_t i = 0; i < pictures.size() && some.size() < count; i += every) {
    some.push_back(pictures[i]);
  }
  return some;
}

engine::Quantization calibrated(const SegmentationModel& model, const QuantizeArguments& arguments,
                                const std::vector<PreparedImage>& pictures) {
  engine::Calibration calibration(model, arguments.weights.string());
  RateProgress progress("picture");
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    stop_if_asked();
    calibration.add(pictures[i]);
    progress.show(static_cast<int>(i + 1), static_cast<int>(pictures.size()));
  }
  progress.finish();
  return calibration.quantization({arguments.float_layers.begin(), arguments.float_layers.end()});
}

void print_sensitivities(const SegmentationModel& model, const QuantizeArguments& arguments,
                         const engine::Quantization& quantization,
                         const std::vector<PreparedImage>& pictures) {
  RateProgress progress("layer");
  const auto layers = engine::layer_sensitivities(model, arguments.weights.string(), quantization,
                                                  pictures, [&](int done, int total) {
                                                    progress.show(done, total);
                                                    stop_if_asked();
                                                    return true;
                                                  });
  progress.finish();
  fmt::print("relative change of the outputs with one layer in int8:\n");
  for (const auto& [layer, error] : layers) fmt::print("{:6.2f} %  {}\n", 100.0 * error, layer);
}

void quantize(const QuantizeArguments& arguments) {
  const InterruptGuard interrupt;
  refuse_existing_file(arguments.output, arguments.overwrite);
  const std::string where = arguments.weights.string();
  SegmentationModel model = unpack_model(read_safetensors(arguments.weights), where);
  if (arguments.long_side > 0) resize_input(model.network, arguments.long_side);
  const std::vector<PreparedImage> pictures = pictures_of(arguments, model.network);
  const engine::Quantization quantization = calibrated(model, arguments, pictures);
  const std::vector<PreparedImage> judged = subset_of(pictures, arguments.judged);
  if (arguments.sensitivity) print_sensitivities(model, arguments, quantization, judged);
  const double error = engine::output_error(model, where, quantization, judged);
  if (arguments.int8_weights) model.weights = engine::weights_in_bytes(model, quantization);
  engine::pack_quantization(quantization, model.weights);
  const TensorType type = arguments.int8_weights ? TensorType::kInt8 : TensorType::kFloat16;
  write_safetensors(arguments.output, pack_model(std::move(model)), type);
  fmt::print("{}: calibrated on {} images, the outputs change by {:.1f} %\n",
             arguments.output.string(), pictures.size(), 100.0 * error);
}

}  // namespace

void add_quantize_command(CLI::App& app) {
  const auto arguments = std::make_shared<QuantizeArguments>();
  CLI::App* command = app.add_subcommand(
      "quantize",
      "Calibrate a network for int8 inference: two to three times as fast with AVX-512 VNNI");
  command->add_option("WEIGHTS", arguments->weights, "weights file of mms train or mms import")
      ->required();
  command
      ->add_option(
          "--data", arguments->data,
          "example images: a file, a folder, or a recording; several separated by commas or spaces")
      ->required()
      ->delimiter(',');
  command
      ->add_option("-o,--output", arguments->output,
                   "weights file to write: the weights in float16, with the ranges for int8")
      ->required();
  add_overwrite_flag(*command, arguments->overwrite);
  command->add_option("--images", arguments->images, "number of calibration images")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100000}))
      ->capture_default_str();
  command
      ->add_option("--long-side", arguments->long_side,
                   "long side of the network's input [px] (default: that of the training)")
      ->check(CLI::Range(96, 4096));
  command
      ->add_option("--float-layers", arguments->float_layers,
                   "convolutions to keep in float32, comma-separated")
      ->delimiter(',');
  command->add_flag("--int8-weights", arguments->int8_weights,
                    "write the weights in int8 as well: half the file, the same results in int8");
  CLI::Option* former = command->add_flag("--bytes", arguments->int8_weights)->group("");
  command->add_flag("--sensitivity", arguments->sensitivity,
                    "print the accuracy loss of each convolution");
  command->callback([arguments, former] {
    if (former->count() > 0) print_warnings({"--bytes is now called --int8-weights"});
    quantize(*arguments);
  });
}

}  // namespace mms
