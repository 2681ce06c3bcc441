#pragma once

#include <string>
#include <vector>

#include "mms/core/weights.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// A trained network: how it is built, what its classes are called, what it learned.
struct SegmentationModel {
  NetworkConfig network;
  std::vector<std::string> classes;  ///< a name for each of network.classes
  Weights weights;                   ///< the metadata are free
};

/// The model as one set of weights that says itself what it is: architecture ("network.head.norm")
/// and class names ("classes") go into the metadata.
Weights pack_model(SegmentationModel model);

/// Reads what `pack_model` wrote; weights in bytes become floats. @throws DataError at `where` when
/// the metadata are missing or make no network.
SegmentationModel unpack_model(Weights weights, const std::string& where);

}  // namespace mms
