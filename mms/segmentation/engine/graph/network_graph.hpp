#pragma once

#include "mms/segmentation/engine/graph/graph.hpp"
#include "mms/segmentation/engine/graph/layer_reader.hpp"

namespace mms::engine {

/// The paper's segmentation network (III-A) as operations, for inputs of height x width [px],
/// multiples of 32. Names and indices of values do not depend on the size.
/// @param layers  of a network that fits `config`; SAC must be none or plain
Graph network_graph(const NetworkConfig& config, LayerReader& layers, int height, int width);

}  // namespace mms::engine
