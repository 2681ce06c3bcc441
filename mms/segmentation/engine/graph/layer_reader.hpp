#pragma once

#include <map>
#include <string>
#include <utility>

#include "mms/core/weights.hpp"
#include "mms/segmentation/engine/graph/conv_layer.hpp"

namespace mms::engine {

/// Stride and dilation of a square kernel.
struct ConvShape {
  int stride = 1;    ///< [px]
  int dilation = 1;  ///< [px]
  bool relu = false;
};

/// A scale and a shift per channel: a batch norm at inference.
struct ChannelAffine {
  std::vector<float> scale;
  std::vector<float> shift;
};

/// Name of a layer's tensor: its weight; for the dilated convolution of a switchable one, the
/// difference to the other.
std::string weight_name(const std::string& layer);

/// Creates the convolutions of a trained network from its tensors, each once. The tensors must fit
/// the network (`expected_tensors`).
class LayerReader {
 public:
  explicit LayerReader(Weights weights) : weights_(std::move(weights)) {}

  /// A convolution of the backbone without bias, with the following batch norm folded in. With
  /// NAME.weight_gamma and NAME.weight_beta its weights are standardized first (DetectoRS).
  ConvLayerPtr backbone_conv(const std::string& name, const std::string& norm,
                             const ConvShape& shape);
  /// The two weights of a switchable atrous convolution at dilations 1 and 3, without bias.
  ConvLayerPtr switchable_small(const std::string& name, int stride);
  ConvLayerPtr switchable_large(const std::string& name, int stride);
  /// NAME.weight with NAME.bias.
  ConvLayerPtr biased_conv(const std::string& name, const ConvShape& shape = {});
  /// NAME.conv with the batch norm NAME.bn and ReLU.
  /// @param level  of the pyramid, whose statistics the norm takes if it has some for each
  ConvLayerPtr head_unit(const std::string& name, std::size_t level = 0);
  /// NAME.conv without bias, norm and ReLU.
  ConvLayerPtr bare_unit(const std::string& name);

  ChannelAffine batch_norm(const std::string& name, std::size_t level = 0) const;
  const std::vector<float>& values(const std::string& name) const;
  const Weights& weights() const { return weights_; }
  bool has(const std::string& name) const { return weights_.tensors.contains(name); }

 private:
  ConvLayer unbiased(const std::string& name, const ConvShape& shape);
  void standardise(ConvLayer& layer) const;
  ConvLayerPtr kept(const std::string& key, ConvLayer layer);
  ConvLayerPtr known(const std::string& key) const;

  Weights weights_;  ///< weights of large convolutions are moved into their layers
  std::map<std::string, ConvLayerPtr> layers_;
};

}  // namespace mms::engine
