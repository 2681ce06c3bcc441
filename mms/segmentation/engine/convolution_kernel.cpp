#include "mms/segmentation/engine/convolution_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace mms::engine {
namespace {

using dnnl::memory;

constexpr float kMaxInt8 = 127.0F;

memory::data_type data_type(Number number) {
  switch (number) {
    case Number::kSigned8:
      return memory::data_type::s8;
    case Number::kUnsigned8:
      return memory::data_type::u8;
    case Number::kFloat:
      break;
  }
  return memory::data_type::f32;
}

memory::dims weight_sides(const ConvLayer& layer) {
  return {layer.out, layer.in, layer.kernel, layer.kernel};
}

memory::dims both(int length) {
  return {length, length};
}

/// Output = scale * (products + bias), per channel when quantized.
std::vector<float> output_scales(ConvolutionLibrary& library, const ConvLayerPtr& layer,
                                 const Format& in, const Format& out) {
  std::vector<float> scales = library.weight_scales(layer);
  for (float& scale : scales) scale *= in.scale / out.scale;
  return scales;
}

dnnl::primitive_attr attributes(const ConvLayer& layer, const std::vector<float>& scales,
                                const Format& out, const std::optional<Format>& residual) {
  dnnl::primitive_attr attr;
  if (!scales.empty()) attr.set_output_scales(1 << 1, scales);
  dnnl::post_ops after;
  if (residual) after.append_sum(residual->scale / out.scale, data_type(residual->number));
  if (layer.relu) after.append_eltwise(1.0F, dnnl::algorithm::eltwise_relu, 0.0F, 0.0F);
  attr.set_post_ops(after);
  return attr;
}

/// oneDNN positions the kernel by its corners: output (h + before + after - reach) / stride.
dnnl::convolution_forward::primitive_desc describe(const ConvLayer& layer, const Tensor& x,
                                                   const Tensor& y,
                                                   const dnnl::primitive_attr& attr,
                                                   const dnnl::engine& engine) {
  const bool bytes = x.format.number != Number::kFloat;
  const auto weight_type = bytes ? memory::data_type::s8 : memory::data_type::f32;
  const int padding = layer.dilation * (layer.kernel / 2);
  const dnnl::convolution_forward::desc convolution(
      dnnl::prop_kind::forward_inference, dnnl::algorithm::convolution_direct, description(x),
      memory::desc(weight_sides(layer), weight_type, memory::format_tag::any),
      memory::desc({layer.out}, memory::data_type::f32, memory::format_tag::x), description(y),
      both(layer.stride), both(layer.dilation - 1), both(padding), both(padding));
  return {convolution, attr, engine};
}

}  // namespace

memory::desc description(const Tensor& tensor) {
  const Shape& s = tensor.shape;
  return {{1, s.channels, s.height, s.width},
          data_type(tensor.format.number),
          memory::format_tag::nhwc};
}

ConvolutionLibrary::ConvolutionLibrary() : engine_(dnnl::engine::kind::cpu, 0), stream_(engine_) {}

const ConvolutionLibrary::Bytes& ConvolutionLibrary::bytes_of(const ConvLayerPtr& layer) {
  const auto found = bytes_.find(layer.get());
  if (found != bytes_.end()) return found->second;
  const int count = layer->inputs_per_output();
  Bytes bytes;
  bytes.stored.resize(layer->weight.size());
  for (int o = 0; o < layer->out; ++o) {
    const std::ptrdiff_t first = std::ptrdiff_t{o} * count;
    const float* row = layer->weight.data() + first;
    float largest = 0.0F;
    for (int i = 0; i < count; ++i) largest = std::max(largest, std::abs(row[i]));
    const float scale = largest > 0.0F ? largest / kMaxInt8 : 1.0F;
    quantize(row, count, 1.0F / scale, bytes.stored.data() + first);
    bytes.scales.push_back(scale);
  }
  return bytes_[layer.get()] = std::move(bytes);
}

const std::vector<float>& ConvolutionLibrary::weight_scales(const ConvLayerPtr& layer) {
  return bytes_of(layer).scales;
}

memory ConvolutionLibrary::packed(const ConvLayerPtr& layer, const memory::desc& target_format) {
  const auto [first, last] = packed_.equal_range(layer.get());
  for (auto it = first; it != last; ++it) {
    if (it->second.memory.get_desc() == target_format) return it->second.memory;
  }
  const bool bytes = target_format.data_type() == memory::data_type::s8;
  const void* source = bytes ? static_cast<const void*>(bytes_of(layer).stored.data())
                             : static_cast<const void*>(layer->weight.data());
  memory plain(
      memory::desc(weight_sides(*layer), target_format.data_type(), memory::format_tag::oihw),
      engine_,
      const_cast<void*>(source));  // read only
  memory result(target_format, engine_);
  dnnl::reorder(plain, result).execute(stream_, plain, result);
  stream_.wait();
  packed_.emplace(layer.get(), Packed{layer, result});
  return result;
}

ConvolutionKernel::ConvolutionKernel(ConvolutionLibrary& library, const ConvLayerPtr& layer,
                                     const Tensor& x, const Tensor& y,
                                     const std::optional<Format>& residual)
    : bias_(layer->bias) {
  std::vector<float> scales;
  if (x.format.number != Number::kFloat) {
    scales = output_scales(library, layer, x.format, y.format);
    for (std::size_t i = 0; i < bias_.size(); ++i) bias_[i] /= scales[i] * y.format.scale;
  }
  const auto what =
      describe(*layer, x, y, attributes(*layer, scales, y.format, residual), library.engine());
  convolution_ = dnnl::convolution_forward(what);
  const dnnl::engine& engine = library.engine();
  arguments_ = {{DNNL_ARG_SRC, memory(what.src_desc(), engine, x.data)},
                {DNNL_ARG_WEIGHTS, library.packed(layer, what.weights_desc())},
                {DNNL_ARG_BIAS, memory(what.bias_desc(), engine, bias_.data())},
                {DNNL_ARG_DST, memory(what.dst_desc(), engine, y.data)}};
}

}  // namespace mms::engine
