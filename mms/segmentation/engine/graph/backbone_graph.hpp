#pragma once

#include <array>
#include <optional>
#include <string>

#include "mms/segmentation/engine/graph/graph_builder.hpp"
#include "mms/segmentation/engine/graph/layer_reader.hpp"

namespace mms::engine {

inline constexpr int kBackboneStages = 4;

/// C2 to C5: strides 4, 8, 16, 32.
using BackboneFeatures = std::array<ValueId, kBackboneStages>;

/// Feedback of the pyramid to the stages 2 to 4, if any.
using BackboneFeedback = std::optional<std::array<ValueId, kBackboneStages - 1>>;

/// Adds a ResNet on the graph's input.
/// @param name  prefix of its tensors' names
BackboneFeatures add_backbone(GraphBuilder& graph, LayerReader& layers,
                              const BackboneConfig& config, const std::string& name,
                              const BackboneFeedback& feedback);

}  // namespace mms::engine
