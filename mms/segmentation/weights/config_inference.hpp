#pragma once

#include <string>

#include "mms/segmentation/solo/network_config.hpp"
#include "mms/segmentation/weights/layer_shapes.hpp"

namespace mms {

/// Infers the network from the names (the network's own) and shapes of its tensors. Other
/// parameters are those of SOLOv2: 40, 36, 24, 16, 12 cells; with towers of up to 256 channels the
/// light network for images of 768 x 448 px, else the full network for 1333 x 800.
/// @throws DataError at `where` if a required tensor is missing, the backbone is none of ResNet-18,
/// 34 and 50, or a number is out of range of NetworkConfig.
NetworkConfig infer_config(const TensorShapes& tensors, const std::string& where);

}  // namespace mms
