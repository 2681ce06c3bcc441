#pragma once

#include "mms/core/weights.hpp"
#include "mms/segmentation/network/solo_head.hpp"

namespace mms::network {

/// The paper's segmentation network (III-A): ResNet, feature pyramid, SOLOv2 head. Parameter names
/// are those of MMDetection's SOLOv2 and DetectoRS.
class SoloNetworkImpl : public torch::nn::Module {
 public:
  explicit SoloNetworkImpl(const NetworkConfig& config);

  /// @param image  (B, 3, H, W) normalized by `prepare_image`; H and W multiples of 32
  HeadOutput forward(const torch::Tensor& image);

  const NetworkConfig& config() const { return config_; }

  /// Folds batch norms and standardization into the weights, for inference; irreversible.
  void fold();

  /// The backbones: one, or two with recursion.
  std::vector<Backbone> backbones();

 private:
  NetworkConfig config_;
  Backbone backbone_{nullptr};
  Neck neck_{nullptr};
  SoloHead head_{nullptr};
};
TORCH_MODULE(SoloNetwork);

/// Converts the convolutions' weights to channels last, the fastest layout for oneDNN.
void put_channels_last(torch::nn::Module& module);

/// All parameters and statistics by name.
std::map<std::string, torch::Tensor> named_tensors(torch::nn::Module& module);

/// A copy of a network's parameters and statistics.
Weights to_weights(torch::nn::Module& module);

/// Sets the parameters of a network.
/// @throws DataError at `where` with missing, unknown or wrongly shaped tensors; the network is
/// then unchanged.
void load_weights(torch::nn::Module& module, const Weights& weights, const std::string& where);

/// Sets the tensors in `weights` and returns their number.
/// @throws DataError at `where` for a name or shape that the network does not have.
int load_partial_weights(torch::nn::Module& module, const Weights& weights,
                         const std::string& where);

}  // namespace mms::network
