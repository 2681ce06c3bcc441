#pragma once

#include "mms/core/weights.hpp"
#include "mms/segmentation/network/solo_head.hpp"

namespace mms::network {

/// The paper's segmentation network (III-A): ResNet, feature pyramid, SOLOv2 head. Parameters have
/// the names of MMDetection's SOLOv2 and DetectoRS.
class SoloNetworkImpl : public torch::nn::Module {
 public:
  explicit SoloNetworkImpl(const NetworkConfig& config);

  /// @param image  (B, 3, H, W) normalised as `prepare_image` does; H and W multiples of 32
  HeadOutput forward(const torch::Tensor& image);

  const NetworkConfig& config() const { return config_; }

  /// Takes batch norms and standardisation into the weights, for inference; there is no way back.
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

/// Lays the convolutions' weights out with the channels last, which oneDNN is fastest with.
void put_channels_last(torch::nn::Module& module);

/// All parameters and statistics by name.
std::map<std::string, torch::Tensor> named_tensors(torch::nn::Module& module);

/// A copy of a network's parameters and statistics.
Weights to_weights(torch::nn::Module& module);

/// Fills a network. @throws DataError at `where` naming tensors that are missing, too many or of
/// another shape; the network is then as it was.
void load_weights(torch::nn::Module& module, const Weights& weights, const std::string& where);

/// Fills those tensors that `weights` has, and returns how many. @throws DataError at `where` for a
/// name or shape that the network does not have.
int load_partial_weights(torch::nn::Module& module, const Weights& weights,
                         const std::string& where);

}  // namespace mms::network
