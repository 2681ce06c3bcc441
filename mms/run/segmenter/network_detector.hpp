#pragma once

#include <filesystem>
#include <memory>

#include "mms/segmentation/detection/detector.hpp"
#include "mms/segmentation/segmenters/segmentation_config.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// The network that the program comes with: below its folder when installed, in the source tree
/// when built there. @throws FileError when it is in neither place.
std::filesystem::path default_weights();

/// The network of the settings: our safetensors, or an ONNX model with YOLO's outputs.
/// @throws FileError, DataError when the file cannot be read or holds no such network; Error when
///         the program was built without what it takes.
std::unique_ptr<Detector> make_detector(const SegmentationConfig& config);

/// Gives the network's input another long side [px] and keeps its shape.
void resize_input(NetworkConfig& network, int long_side);

std::unique_ptr<Segmenter> make_network_segmenter(const SegmentationConfig& config);

}  // namespace mms
