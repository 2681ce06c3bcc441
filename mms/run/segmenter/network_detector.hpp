#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "mms/segmentation/detection/detector.hpp"
#include "mms/segmentation/segmenters/segmentation_config.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// Path of a network.
/// @param weights  a file; the name of one that is part of the program, as "nano"; empty: the
///                 default one. Those are in the installation, or in the source tree of a build.
/// @throws FileError if a name is in neither.
std::filesystem::path weights_path(const std::string& weights);

/// The network of the settings: our safetensors, or an ONNX model with YOLO outputs.
/// @throws FileError, DataError if the file cannot be read or has no such network; Error if the
/// program was built without its backend.
std::unique_ptr<Detector> make_detector(const SegmentationConfig& config);

/// Sets the long side [px] of the network's input; keeps the aspect ratio.
void resize_input(NetworkConfig& network, int long_side);

std::unique_ptr<Segmenter> make_network_segmenter(const SegmentationConfig& config);

}  // namespace mms
