#include "mms/training/run/trainer.hpp"

#include <ATen/Context.h>
#include <torch/cuda.h>
#include <torch/optim/adamw.h>
#include <torch/optim/sgd.h>
#include <torch/serialize.h>

#include <sstream>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/segmentation/network/mixed_precision.hpp"
#include "mms/training/run/losses.hpp"
#include "mms/training/run/schedule.hpp"

namespace mms {
namespace {

constexpr const char* kStepsKey = "steps";

/// The processes of a machine use its GPUs in turn.
torch::Device choose_device(const TrainingConfig& config, const ProcessGroup& group) {
  if (!uses_cuda(config)) return torch::kCPU;
  // All batches have one of two shapes, so that a search for the fastest convolutions pays.
  at::globalContext().setBenchmarkCuDNN(true);
  const int number = group.place().local_rank % static_cast<int>(torch::cuda::device_count());
  return torch::Device(torch::kCUDA, static_cast<torch::DeviceIndex>(number));
}

void prepare_backbones(network::SoloNetwork& network, const ScheduleConfig& schedule) {
  for (network::Backbone& backbone : network->backbones()) {
    backbone->freeze(schedule.frozen_stages);
    backbone->keep_statistics(schedule.kept_statistics);
  }
}

/// For what is added to a trained network.
void freeze_others(network::SoloNetwork& network, TrainedLayers trained) {
  if (trained == TrainedLayers::kAll) return;
  const char* prefix = trained == TrainedLayers::kHead ? "mask_head." : "mask_head.conv_kernel.";
  for (auto& item : network->named_parameters()) {
    if (!item.key().starts_with(prefix)) item.value().set_requires_grad(false);
  }
}

/// Parameters to train: those of the backbones, and all others.
std::array<std::vector<torch::Tensor>, 2> parameter_groups(network::SoloNetwork& network) {
  std::array<std::vector<torch::Tensor>, 2> groups;
  for (const auto& item : network->named_parameters()) {
    if (!item.value().requires_grad()) continue;
    const bool backbone =
        item.key().starts_with("backbone.") || item.key().starts_with("neck.rfp_modules.");
    groups[backbone ? 0 : 1].push_back(item.value());
  }
  return groups;
}

std::unique_ptr<torch::optim::Optimizer> make_optimizer(network::SoloNetwork& network,
                                                        const ScheduleConfig& schedule) {
  std::vector<torch::optim::OptimizerParamGroup> groups;
  for (auto& parameters : parameter_groups(network)) groups.emplace_back(parameters);
  if (schedule.optimizer == Optimizer::kAdamW) {
    return std::make_unique<torch::optim::AdamW>(
        groups,
        torch::optim::AdamWOptions(schedule.learning_rate).weight_decay(schedule.weight_decay));
  }
  return std::make_unique<torch::optim::SGD>(groups,
                                             torch::optim::SGDOptions(schedule.learning_rate)
                                                 .momentum(schedule.momentum)
                                                 .weight_decay(schedule.weight_decay));
}

/// Saves memory traffic compared to setting them to zero.
void forget_gradients(torch::nn::Module& network) {
  for (torch::Tensor& parameter : network.parameters()) parameter.mutable_grad() = torch::Tensor();
}

void set_learning_rate(torch::optim::Optimizer& optimizer, const ScheduleConfig& schedule,
                       int step) {
  const double rate = learning_rate_at(schedule, step);
  auto& groups = optimizer.param_groups();
  groups[0].options().set_lr(rate * schedule.backbone_factor);
  groups[1].options().set_lr(rate);
}

}  // namespace

Trainer::Trainer(const TrainingConfig& config, ProcessGroup& group)
    : config_(config),
      group_(group),
      device_(choose_device(config, group)),
      network_(config.network),
      average_(config.network) {
  prepare_backbones(network_, config.schedule);
  freeze_others(network_, config.schedule.trained);
  network_->to(device_);
  average_->to(device_);
  network::put_channels_last(*network_);
  if (group.size() > 1) network::share_statistics(*network_, group.as_sum());
  average_->eval();
  network::load_weights(*average_, network::to_weights(*network_), "a copy of the network");
  optimizer_ = make_optimizer(network_, config.schedule);
}

void Trainer::initialise(const Weights& weights, const std::string& where) {
  network::load_partial_weights(*network_, weights, where);
  network::load_partial_weights(*average_, weights, where);
}

torch::Tensor Trainer::step(const Batch& batch) {
  set_learning_rate(*optimizer_, config_.schedule, steps_);
  forget_gradients(*network_);
  network_->train(config_.schedule.trained == TrainedLayers::kAll);
  const torch::Tensor images =
      batch.images.to(device_, /*non_blocking=*/true).contiguous(at::MemoryFormat::ChannelsLast);
  network::HeadOutput output;
  {
    const network::MixedPrecision precision(config_.half_precision, device_.type());
    output = network_->forward(images);
  }
  const SoloLoss parts =
      solo_loss(output, batch.targets, images, group_.as_sum(), config_.schedule.mask_pairs);
  const torch::Tensor loss = parts.category + config_.schedule.mask_weight * parts.mask;
  loss.backward();
  add_gradients();
  clip_gradients();
  optimizer_->step();
  update_average();
  ++steps_;
  return torch::stack({loss.detach(), parts.category.detach(), parts.mask.detach()});
}

/// Of all processes, in one message.
void Trainer::add_gradients() {
  if (group_.size() == 1) return;
  const torch::NoGradGuard no_grad;
  std::vector<torch::Tensor> own;
  std::vector<std::int64_t> sizes;
  for (const torch::Tensor& p : network_->parameters()) {
    if (!p.grad().defined()) continue;
    own.push_back(p.grad().reshape(-1));
    sizes.push_back(p.numel());
  }
  const auto totals = group_.sum(torch::cat(own)).split_with_sizes(sizes);
  auto total = totals.begin();
  for (const torch::Tensor& p : network_->parameters()) {
    if (p.grad().defined()) p.grad().copy_((total++)->view_as(p.grad()));
  }
}

/// As torch's clip_grad_norm_, which would wait for the GPU.
void Trainer::clip_gradients() {
  const torch::NoGradGuard no_grad;
  std::vector<torch::Tensor> norms;
  for (const torch::Tensor& p : network_->parameters()) {
    if (p.grad().defined()) norms.push_back(p.grad().norm());
  }
  constexpr double kEpsilon = 1e-6;  // as in torch
  const torch::Tensor factor =
      (config_.schedule.clip_norm / (torch::stack(norms).norm() + kEpsilon)).clamp_max(1.0);
  for (const torch::Tensor& p : network_->parameters()) {
    if (p.grad().defined()) p.grad().mul_(factor);
  }
}

void Trainer::update_average() {
  const torch::NoGradGuard no_grad;
  const double kept = ema_decay_at(config_.schedule, steps_);
  auto averages = network::named_tensors(*average_);
  for (const auto& [name, tensor] : network::named_tensors(*network_)) {
    averages.at(name).lerp_(tensor, 1.0 - kept);
  }
}

void Trainer::write(std::ostream& stream) {
  torch::serialize::OutputArchive archive;
  torch::serialize::OutputArchive network;
  torch::serialize::OutputArchive average;
  torch::serialize::OutputArchive optimizer;
  network_->save(network);
  average_->save(average);
  optimizer_->save(optimizer);
  archive.write("network", network);
  archive.write("average", average);
  archive.write("optimizer", optimizer);
  archive.write(kStepsKey, torch::tensor(static_cast<std::int64_t>(steps_)));
  archive.save_to(stream);
}

void Trainer::save(const std::filesystem::path& path) {
  AtomicFile file(path);
  write(file.stream());
  file.commit();
}

void Trainer::load(const std::filesystem::path& path) {
  std::istringstream stream(read_file(path));
  read(stream, path.string());
}

void Trainer::share_state() {
  if (group_.size() == 1) return;
  std::ostringstream own;
  if (group_.is_first()) write(own);
  std::istringstream first(group_.broadcast(own.str()));
  read(first, "the first process");
}

void Trainer::read(std::istream& stream, const std::string& where) {
  try {
    torch::serialize::InputArchive archive;
    torch::serialize::InputArchive network;
    torch::serialize::InputArchive average;
    torch::serialize::InputArchive optimizer;
    archive.load_from(stream, device_);
    archive.read("network", network);
    archive.read("average", average);
    archive.read("optimizer", optimizer);
    network_->load(network);
    average_->load(average);
    optimizer_->load(optimizer);
    torch::Tensor steps;
    archive.read(kStepsKey, steps);
    steps_ = static_cast<int>(steps.item<std::int64_t>());
  } catch (const c10::Error& error) {
    throw DataError(where, "is not a checkpoint of this network",
                    std::string("torch says: ") + error.what_without_backtrace());
  }
  network::put_channels_last(*network_);
}

}  // namespace mms
