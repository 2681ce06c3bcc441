#pragma once

#include <string>

#include "mms/segmentation/onnx/onnx_config.hpp"
#include "mms/segmentation/segmenters/network_segmenter.hpp"
#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms {

/// Backend of our networks: oneDNN in the engine, or libtorch (GPU; deformable convolutions).
enum class NetworkBackend { kAuto, kEngine, kLibtorch };

/// Number format of the engine.
enum class NetworkPrecision { kAuto, kFloat32, kInt8 };

/// Settings of the segmentation with a network (III-A).
struct SegmentationConfig {
  std::string weights;                             ///< weights file; empty: the default network
  NetworkBackend backend = NetworkBackend::kAuto;  ///< kAuto: the engine, on GPUs libtorch
  NetworkPrecision precision = NetworkPrecision::kAuto;  ///< kAuto: int8 if quantized
  int long_side = 0;               ///< long side of the network's input [px]; 0: as trained
  int threads = 1;                 ///< of the network; separate from those of the other stages
  NetworkSegmenterConfig objects;  ///< which detections become instances
  DecoderConfig decoder;           ///< of our networks
  OnnxConfig onnx;                 ///< of ONNX models

  /// Declares the settings.
  void visit(ConfigVisitor& v);
};

}  // namespace mms
