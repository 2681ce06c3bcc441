#pragma once

#include <cstdint>
#include <map>
#include <oneapi/dnnl/dnnl.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "mms/segmentation/engine/tensor.hpp"

namespace mms::engine {

/// oneDNN's engine and stream, and weights in the forms in which its convolutions want them; each
/// is made once and shared by the plans of all sizes.
class ConvolutionLibrary {
 public:
  ConvolutionLibrary();

  const dnnl::engine& engine() const { return engine_; }
  dnnl::stream& stream() { return stream_; }

  /// A layer's weights, as bytes when `type` says so, laid out as `wanted`.
  dnnl::memory packed(const ConvLayerPtr& layer, const dnnl::memory::desc& wanted);

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

/// A convolution between two maps in memory, float32 or bytes by the format of its input.
class ConvolutionKernel {
 public:
  /// @param residual  format of the map that is added: it is found in y, where the result replaces
  ///                  it; nothing: none is added
  ConvolutionKernel(ConvolutionLibrary& library, const ConvLayerPtr& layer, const Tensor& x,
                    const Tensor& y, const std::optional<Format>& residual);

  void run(dnnl::stream& stream) { convolution_.execute(stream, arguments_); }

 private:
  std::vector<float> bias_;  ///< in units of the accumulated products
  dnnl::convolution_forward convolution_;
  std::unordered_map<int, dnnl::memory> arguments_;
};

/// Memory of a map for oneDNN.
dnnl::memory::desc description(const Tensor& tensor);

}  // namespace mms::engine
