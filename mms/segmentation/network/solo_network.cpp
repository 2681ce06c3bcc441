#include "mms/segmentation/network/solo_network.hpp"

#include <algorithm>

#include "mms/segmentation/weights/tensor_shapes.hpp"

namespace mms::network {
namespace {

TensorShapes shapes_of(torch::nn::Module& module) {
  TensorShapes shapes;
  for (const auto& [name, tensor] : named_tensors(module)) shapes[name] = tensor.sizes().vec();
  return shapes;
}

void copy_into(torch::Tensor& target, const WeightTensor& given) {
  const torch::NoGradGuard no_grad;
  const auto count = static_cast<std::int64_t>(given.values.size());
  target.copy_(torch::from_blob(const_cast<float*>(given.values.data()), {count}, torch::kFloat)
                   .view(target.sizes()));
}

}  // namespace

SoloNetworkImpl::SoloNetworkImpl(const NetworkConfig& config) : config_(config) {
  backbone_ = register_module("backbone", Backbone(config.backbone, 0));
  neck_ = register_module("neck", Neck(config.neck, config.backbone, backbone_->channels()));
  head_ = register_module("mask_head", SoloHead(config.head, config.neck.channels, config.classes));
}

HeadOutput SoloNetworkImpl::forward(const torch::Tensor& image) {
  return head_->forward(neck_->forward(image, backbone_->forward(image)));
}

std::vector<Backbone> SoloNetworkImpl::backbones() {
  std::vector<Backbone> all = {backbone_};
  if (Backbone second = neck_->second_backbone(); !second.is_empty()) all.push_back(second);
  return all;
}

void SoloNetworkImpl::fold() {
  const torch::NoGradGuard no_grad;
  for (Backbone& backbone : backbones()) backbone->fold();
  for (const auto& module : head_->modules()) {
    if (auto* unit = module->as<HeadUnitImpl>()) unit->fold();
  }
}

void put_channels_last(torch::nn::Module& module) {
  for (torch::Tensor& p : module.parameters()) {
    if (p.dim() == 4) p.set_data(p.data().contiguous(at::MemoryFormat::ChannelsLast));
  }
}

std::map<std::string, torch::Tensor> named_tensors(torch::nn::Module& module) {
  std::map<std::string, torch::Tensor> tensors;
  for (const auto& item : module.named_parameters()) tensors[item.key()] = item.value();
  for (const auto& item : module.named_buffers()) {
    if (!item.key().ends_with("num_batches_tracked")) tensors[item.key()] = item.value();
  }
  return tensors;
}

Weights to_weights(torch::nn::Module& module) {
  Weights weights;
  for (const auto& [name, tensor] : named_tensors(module)) {
    const torch::Tensor flat =
        tensor.detach().to(torch::kCPU, torch::kFloat).contiguous(at::MemoryFormat::Contiguous);
    const float* data = flat.data_ptr<float>();
    weights.tensors[name] = {flat.sizes().vec(), {data, data + flat.numel()}};
  }
  return weights;
}

int load_partial_weights(torch::nn::Module& module, const Weights& weights,
                         const std::string& where) {
  check_fitting(weights, shapes_of(module), where);
  std::map<std::string, torch::Tensor> tensors = named_tensors(module);
  for (const auto& [name, given] : weights.tensors) copy_into(tensors.at(name), given);
  return static_cast<int>(weights.tensors.size());
}

void load_weights(torch::nn::Module& module, const Weights& weights, const std::string& where) {
  check_complete(weights, shapes_of(module), where);
  load_partial_weights(module, weights, where);
}

}  // namespace mms::network
