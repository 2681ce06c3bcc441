#pragma once

#include <vector>

#include "mms/segmentation/network/solo_network.hpp"
#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms::network {

/// Asks a network for the objects in one picture. The network is to be in evaluation mode.
std::vector<Detection> detect(SoloNetwork& network, const Image<Rgb>& image,
                              const DecoderConfig& config);

/// The maps of the first image of a batch, on the CPU; `output` is replaced by float32 tensors
/// with their channels last, which the maps point into.
HeadMaps head_maps(HeadOutput& output);

}  // namespace mms::network
