#pragma once

#include <cstdint>
#include <map>
#include <oneapi/dnnl/dnnl.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "mms/segmentation/engine/tensor.hpp"

namespace mms::engine {

/// oneDNN's engine and stream, and weights in the layouts of its convolutions, shared by the plans
/// of all sizes.
class ConvolutionLibrary {
 public:
  ConvolutionLibrary();

  const dnnl::engine& engine() const { return engine_; }
  dnnl::stream& stream() { return stream_; }

  /// A layer's weights in the layout `target_format`, converted to int8 if its type requires it.
  dnnl::memory packed(const ConvLayerPtr& layer, const dnnl::memory::desc& target_format);

  /// Per output channel: weight = stored * scale.
  const std::vector<float>& weight_scales(const ConvLayerPtr& layer);

 private:
  struct Bytes {
    std::vector<std::int8_t> stored;
    std::vector<float> scales;
  };
  struct Packed {
    ConvLayerPtr layer;  ///< keeps the key alive
    dnnl::memory memory;
  };

  const Bytes& bytes_of(const ConvLayerPtr& layer);

  dnnl::engine engine_;
  dnnl::stream stream_;
  std::unordered_map<const ConvLayer*, Bytes> bytes_;
  std::unordered_multimap<const ConvLayer*, Packed> packed_;
};

/// A convolution between two maps in memory, float32 or int8 depending on its input.
class ConvolutionKernel {
 public:
  /// @param residual  format of the map to add, which is in y and is replaced by the result;
  /// nullopt: none
  ConvolutionKernel(ConvolutionLibrary& library, const ConvLayerPtr& layer, const Tensor& x,
                    const Tensor& y, const std::optional<Format>& residual);

  void run(dnnl::stream& stream) { convolution_.execute(stream, arguments_); }

 private:
  std::vector<float> bias_;  ///< in units of the accumulated products
  dnnl::convolution_forward convolution_;
  std::unordered_map<int, dnnl::memory> arguments_;
};

/// oneDNN description of a map.
dnnl::memory::desc description(const Tensor& tensor);

}  // namespace mms::engine
