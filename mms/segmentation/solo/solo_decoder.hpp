#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/core/image.hpp"
#include "mms/segmentation/solo/network_config.hpp"
#include "mms/segmentation/solo/prepared_image.hpp"

namespace mms {

/// A float32 map, channels last, cells row by row. Maps of one grid may be interleaved in one
/// buffer.
struct ChannelsLastMap {
  const float* data = nullptr;  ///< the first cell's first channel
  int pitch = 0;                ///< floats between consecutive cells, at least the channels

  const float* cell(int index) const { return data + static_cast<std::ptrdiff_t>(index) * pitch; }
};

/// One image's output of the head.
struct HeadMaps {
  std::array<ChannelsLastMap, HeadConfig::kLevels> categories{};  ///< logits, S x S x classes
  /// S x S x `HeadConfig::kernel_length()`
  std::array<ChannelsLastMap, HeadConfig::kLevels> kernels{};
  ChannelsLastMap mask_features;  ///< mask_height x mask_width x E
  int mask_width = 0;             ///< a quarter of the input's [px]
  int mask_height = 0;
};

/// One detected object.
struct Detection {
  int category = 0;          ///< index of its class
  float score = 0.0F;        ///< in [0, 1]
  int x = 0;                 ///< left column of `mask` in the image [px]
  int y = 0;                 ///< top row [px]
  Image<std::uint8_t> mask;  ///< cropped to the object: 1 on the object
};

/// Thresholds of the decoder.
struct DecoderConfig {
  double candidate_score = 0.1;  ///< smallest probability of a cell's category
  double score = 0.05;           ///< smallest score after matrix NMS
  int candidates = 500;          ///< largest number before matrix NMS
  int instances = 100;           ///< largest number after matrix NMS

  void visit(ConfigVisitor& v);
};

/// Decodes the head's maps into objects (SOLOv2: point NMS, dynamic convolution, maskness, matrix
/// NMS), highest score first, with masks at the size of the image.
std::vector<Detection> decode(const HeadMaps& maps, const NetworkConfig& network,
                              const PreparedImage& prepared, const DecoderConfig& config);

}  // namespace mms
