#pragma once

#include <vector>

#include "mms/segmentation/network/solo_network.hpp"
#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms::network {

/// Detects the objects in one image. The network must be in evaluation mode.
std::vector<Detection> detect(SoloNetwork& network, const Image<Rgb>& image,
                              const DecoderConfig& config);

/// The maps of the first image of a batch, on the CPU; `output` is replaced by float32 tensors with
/// channels last that own the data.
HeadMaps head_maps(HeadOutput& output);

}  // namespace mms::network
