#include "mms/segmentation/network/batch_norm.hpp"

#include <ATen/Context.h>
#include <torch/types.h>

namespace mms::network {
namespace {

constexpr double kEpsilon = 1e-5;  // this and the momentum: torch's defaults
constexpr double kMomentum = 0.1;

/// As `sum`, with the gradient: what one process adds changes the losses of all.
torch::Tensor differentiable_sum(const torch::Tensor& x, const ProcessSum& sum) {
  const torch::Tensor detached = x.detach();
  const torch::Tensor total = sum(detached) + (x - detached);  // the second part is exactly 0
  if (total.requires_grad()) total.register_hook([sum](torch::Tensor grad) { return sum(grad); });
  return total;
}

}  // namespace

BatchNormImpl::BatchNormImpl(std::int64_t channels)
    : weight_(register_parameter("weight", torch::ones({channels}))),
      bias_(register_parameter("bias", torch::zeros({channels}))),
      mean_(register_buffer("running_mean", torch::zeros({channels}))),
      variance_(register_buffer("running_var", torch::ones({channels}))),
      batches_(register_buffer("num_batches_tracked", torch::tensor(0, torch::kLong))) {}

torch::Tensor BatchNormImpl::forward(const torch::Tensor& x) {
  if (sum_ && is_training()) return shared_forward(x);
  if (is_training()) batches_ += 1;
  return torch::batch_norm(x, weight_, bias_, mean_, variance_, is_training(), kMomentum, kEpsilon,
                           at::globalContext().userEnabledCuDNN());
}

std::pair<torch::Tensor, torch::Tensor> BatchNormImpl::scale_and_shift() const {
  const torch::NoGradGuard no_grad;
  const torch::Tensor scale = weight_ / (variance_ + kEpsilon).sqrt();
  return {scale, bias_ - mean_ * scale};
}

torch::Tensor BatchNormImpl::shared_forward(const torch::Tensor& x) {
  const auto column = [](const torch::Tensor& values) { return values.view({1, -1, 1, 1}); };
  const torch::Tensor values = x.to(torch::kFloat);
  const torch::Tensor count = sum_(
      torch::full({1}, static_cast<double>(x.size(0) * x.size(2) * x.size(3)), values.options()));
  const torch::Tensor mean = differentiable_sum(values.sum({0, 2, 3}), sum_) / count;
  const torch::Tensor centered = values - column(mean);
  const torch::Tensor variance = differentiable_sum(centered.square().sum({0, 2, 3}), sum_) / count;
  {
    const torch::NoGradGuard no_grad;
    mean_.lerp_(mean, kMomentum);
    variance_.lerp_(variance * count / (count - 1), kMomentum);
    batches_ += 1;
  }
  const torch::Tensor scale = weight_ / (variance + kEpsilon).sqrt();
  return (centered * column(scale) + column(bias_)).to(x.scalar_type());
}

void share_statistics(torch::nn::Module& module, const ProcessSum& sum) {
  for (const auto& child : module.modules()) {
    if (auto* norm = child->as<BatchNormImpl>()) norm->share(sum);
  }
}

}  // namespace mms::network
