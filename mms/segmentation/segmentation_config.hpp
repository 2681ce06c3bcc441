#pragma once

#include <string>

#include "mms/segmentation/network_segmenter.hpp"
#include "mms/segmentation/onnx/onnx_config.hpp"
#include "mms/segmentation/solo_decoder.hpp"

namespace mms {

/// Settings of the segmentation with a network (III-A).
struct SegmentationConfig {
  std::string weights;  ///< a file; empty: the network that the program comes with
  int threads = 1;      ///< of the network; the rest of the program has its own
  NetworkSegmenterConfig objects;
  DecoderConfig decoder;  ///< of our networks
  OnnxConfig onnx;        ///< of ONNX models

  void visit(ConfigVisitor& v);
};

}  // namespace mms
