#pragma once

#include <string>

#include "mms/core/weights.hpp"
#include "mms/segmentation/solo/network_config.hpp"
#include "mms/segmentation/weights/layer_shapes.hpp"

namespace mms {

/// Names and shapes of all parameters and statistics of a network, as in its weights file. Names
/// are MMDetection's (SOLOv2 and DetectoRS) without the counters `num_batches_tracked`.
TensorShapes expected_tensors(const NetworkConfig& config);

/// @throws DataError at `where` for an unexpected tensor or a wrong shape.
void check_fitting(const Weights& weights, const TensorShapes& expected, const std::string& where);

/// @throws DataError at `where` for a missing tensor as well.
void check_complete(const Weights& weights, const TensorShapes& expected, const std::string& where);

}  // namespace mms
