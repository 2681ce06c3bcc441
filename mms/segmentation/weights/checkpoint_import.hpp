#pragma once

#include <string>

#include "mms/core/weights.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// A converted network of another framework.
struct ImportedNetwork {
  NetworkConfig config;  ///< from the tensors' names and shapes, see `infer_config`
  Weights weights;       ///< exactly `expected_tensors(config)`; metadata unchanged
};

/// Converts a trained SOLOv2 of MMDetection (including DetectoRS' RFP and SAC), WXinlong/SOLO or
/// AdelaiDet. Values are unchanged, except for AdelaiDet's first convolution, which is converted to
/// our input (normalized RGB; detectron2 has BGR with a standard deviation of 1). AdelaiDet's
/// ResNet-50 has the stride in another convolution of a block than this network: metadata "note"
/// then says that it requires further training.
/// @throws DataError at `where` with the tensors (names of the checkpoint) that are unknown,
/// missing, duplicate or of a wrong shape, and as `infer_config`.
ImportedNetwork import_checkpoint(Weights checkpoint, const std::string& where);

}  // namespace mms
