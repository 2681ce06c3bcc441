#include "mms/segmentation/engine/network_engine.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/segmentation/engine/graph/network_graph.hpp"
#include "mms/segmentation/weights/tensor_shapes.hpp"

namespace mms::engine {
namespace {

/// Converts planes to channels last.
void write_input(const PreparedImage& image, const Tensor& input) {
  const int pixels = input.shape.pixels();
  float* next = input.floats();
  for (int pixel = 0; pixel < pixels; ++pixel) {
    for (int channel = 0; channel < input.shape.channels; ++channel) {
      *next++ = image.planes[static_cast<std::size_t>(channel * pixels + pixel)];
    }
  }
}

ChannelsLastMap head_map(const Plan& plan, ValueId id) {
  const Tensor tensor = plan.tensor(id);
  return {tensor.floats(), tensor.shape.channels};
}

void check_supported(const NetworkConfig& config, const std::string& where) {
  if (config.backbone.sac != SacMode::kDeformable) return;
  throw DataError(where, "has deformable convolutions, which require libtorch",
                  "use segmentation.backend: libtorch, or a network with sac: plain");
}

}  // namespace

NetworkEngine::NetworkEngine(SegmentationModel model, const std::string& where,
                             Quantization quantization)
    : config_(model.network),
      classes_(std::move(model.classes)),
      where_(where),
      quantization_(std::move(quantization)),
      layers_(std::move(model.weights)) {
  check_supported(config_, where);
  check_complete(layers_.weights(), expected_tensors(config_), where);
}

Plan& NetworkEngine::plan_for(int height, int width) {
  const auto found = std::find_if(plans_.begin(), plans_.end(), [&](const auto& plan) {
    const Shape& shape = plan->graph().value(plan->graph().input).shape;
    return shape.height == height && shape.width == width;
  });
  if (found != plans_.end()) {
    std::rotate(plans_.begin(), found, found + 1);
    return *plans_.front();
  }
  if (plans_.size() == kMaxPlans) plans_.pop_back();
  const Graph graph = network_graph(config_, layers_, height, width);
  check_quantization(quantization_, graph, where_);
  plans_.insert(plans_.begin(), std::make_unique<Plan>(quantized(graph, quantization_), library_));
  return *plans_.front();
}

HeadMaps NetworkEngine::run(const PreparedImage& image, const Plan::Observer& observer) {
  Plan& plan = plan_for(image.height, image.width);
  write_input(image, plan.input());
  plan.run(observer);
  const GraphOutputs& outputs = plan.graph().outputs;
  HeadMaps maps;
  for (std::size_t i = 0; i < maps.categories.size(); ++i) {
    maps.categories[i] = head_map(plan, outputs.categories[i]);
    maps.kernels[i] = head_map(plan, outputs.kernels[i]);
  }
  maps.mask_features = head_map(plan, outputs.mask_features);
  const Shape& mask = plan.graph().value(outputs.mask_features).shape;
  maps.mask_height = mask.height;
  maps.mask_width = mask.width;
  return maps;
}

}  // namespace mms::engine
