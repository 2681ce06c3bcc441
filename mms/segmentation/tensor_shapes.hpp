#pragma once

#include "mms/segmentation/layer_shapes.hpp"
#include "mms/segmentation/network_config.hpp"

namespace mms {

/// Names and shapes of all parameters and statistics of a network, just as its weights file has
/// them. Names are MMDetection's (SOLOv2 and DetectoRS) without the counters `num_batches_tracked`.
TensorShapes expected_tensors(const NetworkConfig& config);

}  // namespace mms
