#include "mms/segmentation/engine/calibration/range_calibration.hpp"

#include <algorithm>
#include <cmath>

#include "mms/core/error.hpp"
#include "mms/segmentation/engine/graph/network_graph.hpp"
#include "mms/segmentation/weights/int8_weights.hpp"
#include "mms/segmentation/weights/weight_standardisation.hpp"

namespace mms::engine {
namespace {

constexpr int kSignedLevels = 127;
constexpr int kUnsignedLevels = 255;

/// Copies of the head's maps for one image.
using Outputs = std::vector<std::vector<float>>;

Outputs outputs_of(NetworkEngine& network, const PreparedImage& image) {
  const HeadMaps maps = network.run(image);
  const HeadConfig& head = network.config().head;
  Outputs outputs;
  const auto copy = [&](const ChannelsLastMap& map, int cells) {
    outputs.emplace_back(map.data, map.data + std::ptrdiff_t{cells} * map.pitch);
  };
  const auto grids = head.grids();
  for (std::size_t i = 0; i < grids.size(); ++i) {
    copy(maps.categories[i], grids[i] * grids[i]);
    copy(maps.kernels[i], grids[i] * grids[i]);
  }
  copy(maps.mask_features, maps.mask_width * maps.mask_height);
  return outputs;
}

std::vector<Outputs> outputs_of(NetworkEngine& network, const std::vector<PreparedImage>& images) {
  std::vector<Outputs> all;
  for (const PreparedImage& image : images) all.push_back(outputs_of(network, image));
  return all;
}

/// Mean squared relative change over all maps.
double relative_change(const std::vector<Outputs>& changed, const std::vector<Outputs>& original) {
  double sum = 0.0;
  double maps = 0.0;
  for (std::size_t i = 0; i < original.size(); ++i) {
    for (std::size_t m = 0; m < original[i].size(); ++m) {
      double change = 0.0;
      double size = 0.0;
      for (std::size_t k = 0; k < original[i][m].size(); ++k) {
        const auto was = static_cast<double>(original[i][m][k]);
        change += std::pow(static_cast<double>(changed[i][m][k]) - was, 2);
        size += was * was;
      }
      sum += size > 0.0 ? change / size : 0.0;
      maps += 1.0;
    }
  }
  return std::sqrt(sum / std::max(maps, 1.0));
}

/// Names of the convolutions in the order of execution.
std::vector<std::string> layer_names(const SegmentationModel& model) {
  constexpr int kAnySide = 128;  // names do not depend on the size
  std::vector<std::string> names;
  LayerReader layers(model.weights);
  for (const Node& node : network_graph(model.network, layers, kAnySide, kAnySide).nodes) {
    const auto* convolution = std::get_if<Convolution>(&node.operation);
    if (convolution == nullptr) continue;
    const std::string& name = convolution->layer->name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace

Calibration::Calibration(const SegmentationModel& model, const std::string& where)
    : where_(where), network_(model, where, {}) {}

void Calibration::add(const PreparedImage& image) {
  network_.run(image, [&](const Value& value, const Tensor& tensor) {
    Seen& seen = values_[value.name];
    seen.non_negative = value.non_negative;
    seen.histogram.add(tensor.floats(), tensor.shape.count());
  });
}

Quantization Calibration::quantization(std::set<std::string> float_layers) const {
  for (const std::string& layer : float_layers) {
    if (values_.contains(layer)) continue;
    throw DataError(where_, "has no convolution '" + layer + "'",
                    "mms quantize --sensitivity lists them");
  }
  Quantization quantization;
  quantization.float_layers = std::move(float_layers);
  for (const auto& [name, seen] : values_) {
    quantization.ranges[name] =
        seen.histogram.best_range(seen.non_negative ? kUnsignedLevels : kSignedLevels);
  }
  return quantization;
}

Weights weights_in_bytes(const SegmentationModel& model, const Quantization& quantization) {
  std::set<std::string> names;
  for (const std::string& layer : layer_names(model)) {
    if (!quantization.float_layers.contains(layer)) names.insert(weight_name(layer));
  }
  Weights weights = model.weights;
  settle_standardisation(weights);
  return to_bytes(std::move(weights), names);
}

double output_error(const SegmentationModel& model, const std::string& where,
                    const Quantization& quantization, const std::vector<PreparedImage>& images) {
  NetworkEngine exact(model, where, {});
  NetworkEngine bytes(model, where, quantization);
  return relative_change(outputs_of(bytes, images), outputs_of(exact, images));
}

std::vector<LayerSensitivity> layer_sensitivities(const SegmentationModel& model,
                                                  const std::string& where,
                                                  const Quantization& quantization,
                                                  const std::vector<PreparedImage>& images,
                                                  const std::function<bool(int, int)>& progress) {
  NetworkEngine exact(model, where, {});
  const std::vector<Outputs> original = outputs_of(exact, images);
  const std::vector<std::string> names = layer_names(model);
  std::vector<LayerSensitivity> sensitivities;
  for (const std::string& name : names) {
    Quantization one = quantization;
    one.float_layers = {names.begin(), names.end()};
    one.float_layers.erase(name);
    NetworkEngine network(model, where, one);
    sensitivities.push_back({name, relative_change(outputs_of(network, images), original)});
    const auto done = static_cast<int>(sensitivities.size());
    if (!progress(done, static_cast<int>(names.size()))) break;
  }
  return sensitivities;
}

}  // namespace mms::engine
