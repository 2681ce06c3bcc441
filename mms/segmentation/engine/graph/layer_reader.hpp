#pragma once

#include <map>
#include <string>
#include <utility>

#include "mms/core/weights.hpp"
#include "mms/segmentation/engine/graph/conv_layer.hpp"

namespace mms::engine {

/// Where and how a square kernel is laid over a map.
struct ConvShape {
  int stride = 1;    ///< [px]
  int dilation = 1;  ///< [px]
  bool relu = false;
};

/// A scale and a shift per channel: what a batch norm does at inference.
struct ChannelAffine {
  std::vector<float> scale;
  std::vector<float> shift;
};

/// The tensor that has what is a layer's own: its weight, or of the dilated convolution of a
/// switchable one the difference to the other.
std::string weight_name(const std::string& layer);

/// Makes the convolutions of a trained network from its tensors, each once however often it is
/// asked for. The tensors are to fit the network (`expected_tensors`).
class LayerReader {
 public:
  explicit LayerReader(Weights weights) : weights_(std::move(weights)) {}

  /// A convolution of the backbone without bias, the batch norm after it taken in. Where there are
  /// NAME.weight_gamma and NAME.weight_beta its weights are standardised first (DetectoRS).
  ConvLayerPtr backbone_conv(const std::string& name, const std::string& norm,
                             const ConvShape& shape);
  /// The two weights of a switchable atrous convolution at dilations 1 and 3, without bias.
  ConvLayerPtr switchable_small(const std::string& name, int stride);
  ConvLayerPtr switchable_large(const std::string& name, int stride);
  /// NAME.weight with NAME.bias.
  ConvLayerPtr biased_conv(const std::string& name, const ConvShape& shape = {});
  /// NAME.conv with the batch norm NAME.bn and ReLU.
  ConvLayerPtr head_unit(const std::string& name);
  /// NAME.conv without bias, norm and ReLU.
  ConvLayerPtr bare_unit(const std::string& name);

  ChannelAffine batch_norm(const std::string& name) const;
  const std::vector<float>& values(const std::string& name) const;
  const Weights& weights() const { return weights_; }
  bool has(const std::string& name) const { return weights_.tensors.contains(name); }

 private:
  ConvLayer unbiased(const std::string& name, const ConvShape& shape);
  void standardise(ConvLayer& layer) const;
  ConvLayerPtr kept(const std::string& key, ConvLayer layer);
  ConvLayerPtr known(const std::string& key) const;

  Weights weights_;  ///< those of large convolutions move on into their layers
  std::map<std::string, ConvLayerPtr> layers_;
};

}  // namespace mms::engine
