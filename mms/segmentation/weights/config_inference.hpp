#pragma once

#include <string>

#include "mms/segmentation/solo/network_config.hpp"
#include "mms/segmentation/weights/layer_shapes.hpp"

namespace mms {

/// The network that tensors of these names (the network's own) and shapes belong to. What shapes do
/// not tell is taken from SOLOv2: all of its 40, 36, 24, 16, 12 cells; towers of up to 256 channels
/// are the light network's, for images of 768 x 448 px, wider ones the full network's, 1333 x 800.
/// @throws DataError at `where` when a tensor that tells is missing, when the backbone is none of
///         ResNet-18, 34 and 50, or for a number that NetworkConfig does not allow.
NetworkConfig infer_config(const TensorShapes& tensors, const std::string& where);

}  // namespace mms
