#pragma once

#include "mms/segmentation/engine/graph/graph.hpp"
#include "mms/segmentation/engine/graph/layer_reader.hpp"

namespace mms::engine {

/// The paper's segmentation network (III-A) as operations, for inputs of height x width [px],
/// multiples of 32. Values have the same names and places for every size.
/// @param layers  of a network that fits `config`; SAC is to be none or plain
Graph network_graph(const NetworkConfig& config, LayerReader& layers, int height, int width);

}  // namespace mms::engine
