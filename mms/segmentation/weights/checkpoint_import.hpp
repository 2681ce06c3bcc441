#pragma once

#include <string>

#include "mms/core/weights.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// A network of another framework, as this one has it.
struct ImportedNetwork {
  NetworkConfig config;  ///< what the tensors' names and shapes tell, see `infer_config`
  Weights weights;       ///< just `expected_tensors(config)`; metadata as they were
};

/// Translates a trained SOLOv2 of MMDetection (DetectoRS' RFP and SAC included), WXinlong/SOLO or
/// AdelaiDet. The tensors' values stay what they are, but for AdelaiDet's first convolution, which
/// is changed to take our colours (RGB and normalised, where detectron2 has BGR and a deviation
/// of 1). AdelaiDet's ResNet-50 has the stride in another convolution of a block than this network:
/// metadata "note" then says that it has to be trained on.
/// @throws DataError at `where` naming tensors (as in the checkpoint) that are unknown, missing,
///         there twice or of another shape than their network's, and as `infer_config` does.
ImportedNetwork import_checkpoint(Weights checkpoint, const std::string& where);

}  // namespace mms
