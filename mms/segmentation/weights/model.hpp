#pragma once

#include <string>
#include <vector>

#include "mms/core/weights.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// A trained network: architecture, class names and weights.
struct SegmentationModel {
  NetworkConfig network;
  std::vector<std::string> classes;  ///< one name for each of network.classes
  Weights weights;                   ///< with any metadata
};

/// The model as one set of weights: architecture ("network.head.norm") and class names ("classes")
/// are stored in the metadata.
Weights pack_model(SegmentationModel model);

/// Inverse of `pack_model`; int8 weights become floats.
/// @throws DataError at `where` if the metadata are missing or invalid.
SegmentationModel unpack_model(Weights weights, const std::string& where);

}  // namespace mms
