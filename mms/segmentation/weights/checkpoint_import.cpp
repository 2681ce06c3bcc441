#include "mms/segmentation/weights/checkpoint_import.hpp"

#include <algorithm>
#include <array>

#include "mms/core/error.hpp"
#include "mms/segmentation/weights/checkpoint_names.hpp"
#include "mms/segmentation/weights/config_inference.hpp"
#include "mms/segmentation/weights/tensor_shapes.hpp"

namespace mms {
namespace {

constexpr const char* kStem = "backbone.conv1.weight";
constexpr const char* kStrideNote =
    "from detectron2, whose ResNet-50 has the stride in the 1x1 convolutions: requires further "
    "training";

/// A checkpoint's tensors with the network's names.
struct RenamedTensors {
  std::map<std::string, WeightTensor> tensors;
  std::map<std::string, std::string> published;  ///< original names
  bool detectron = false;

  TensorShapes shapes() const {
    TensorShapes shapes;
    for (const auto& [name, tensor] : tensors) shapes[name] = tensor.shape;
    return shapes;
  }
};

RenamedTensors rename(std::map<std::string, WeightTensor>&& tensors, const std::string& where) {
  RenamedTensors renamed;
  for (auto& [published, tensor] : tensors) {
    const std::optional<std::string> name = network_name(published);
    if (!name) continue;
    const auto [other, is_new] = renamed.published.emplace(*name, published);
    if (!is_new) {
      throw DataError(where, "'" + other->second + "' and '" + published + "' are the same tensor");
    }
    renamed.tensors[*name] = std::move(tensor);
    renamed.detectron = renamed.detectron || is_detectron_backbone(published);
  }
  return renamed;
}

void check_no_unknown(const RenamedTensors& found, const TensorShapes& expected,
                      const std::string& where) {
  constexpr int kShown = 3;
  int count = 0;
  std::string names;
  bool deformable = false;
  for (const auto& [name, published] : found.published) {
    if (expected.contains(name)) continue;
    if (count++ < kShown) names += (names.empty() ? "'" : ", '") + published + "'";
    deformable = deformable || name.find(".conv_offset") != std::string::npos;
  }
  if (count == 0) return;
  throw DataError(where,
                  "has " + std::to_string(count) + " tensors that do not fit its network: " +
                      names + (count > kShown ? ", ..." : ""),
                  deformable ? "deformable convolutions are only supported as part of SAC" : "");
}

void check_none_missing(const RenamedTensors& found, const TensorShapes& expected,
                        const std::string& where) {
  int count = 0;
  std::string first;
  for (const auto& [name, shape] : expected) {
    if (found.tensors.contains(name)) continue;
    if (count++ == 0) first = "'" + name + "' " + shape_text(shape);
  }
  if (count == 0) return;
  throw DataError(
      where, "lacks " + std::to_string(count) + " tensors of its network, the first one: " + first);
}

void check_shapes(const RenamedTensors& found, const TensorShapes& expected,
                  const std::string& where) {
  for (const auto& [name, tensor] : found.tensors) {
    const TensorShape& expected_shape = expected.at(name);
    if (tensor.shape != expected_shape) {
      throw DataError(where, "tensor '" + found.published.at(name) + "' has shape " +
                                 shape_text(tensor.shape) + ", expected " +
                                 shape_text(expected_shape));
    }
    const std::size_t count = value_count(expected_shape);
    if (tensor.values.size() == count) continue;
    throw DataError(where, "tensor '" + found.published.at(name) + "' has " +
                               std::to_string(tensor.values.size()) +
                               " values, expected by its shape: " + std::to_string(count));
  }
}

/// Converts weights for BGR to weights for RGB divided by ImageNet's standard deviation.
void take_normalised_rgb(WeightTensor& stem) {
  constexpr std::array<float, 3> kDeviation = {58.395F, 57.12F, 57.375F};  // of red, green, blue
  const std::size_t kernel = static_cast<std::size_t>(stem.shape[2] * stem.shape[3]);
  const std::vector<float> bgr = stem.values;
  for (std::size_t i = 0; i < bgr.size(); ++i) {
    const std::size_t plane = i / kernel;
    const std::size_t channel = plane % kDeviation.size();
    const std::size_t mirrored = plane - channel + (kDeviation.size() - 1 - channel);
    stem.values[i] = bgr[mirrored * kernel + i % kernel] * kDeviation[channel];
  }
}

}  // namespace

ImportedNetwork import_checkpoint(Weights checkpoint, const std::string& where) {
  RenamedTensors found = rename(std::move(checkpoint.tensors), where);
  const NetworkConfig config = infer_config(found.shapes(), where);
  const TensorShapes expected = expected_tensors(config);
  check_no_unknown(found, expected, where);
  check_none_missing(found, expected, where);
  check_shapes(found, expected, where);
  Weights weights{std::move(checkpoint.metadata), std::move(found.tensors)};
  if (found.detectron) {
    take_normalised_rgb(weights.tensors.at(kStem));
    if (config.backbone.depth >= 50) weights.metadata["note"] = kStrideNote;
  }
  return {config, std::move(weights)};
}

}  // namespace mms
