#include "mms/segmentation/network/batch_norm.hpp"

#include <ATen/Context.h>
#include <torch/types.h>

#include <vector>

namespace mms::network {
namespace {

constexpr double kEpsilon = 1e-5;  // this and the momentum: torch's defaults
constexpr double kMomentum = 0.1;

std::vector<std::int64_t> statistics_shape(std::int64_t channels, std::int64_t levels) {
  if (levels == 0) return {channels};
  return {levels, channels};
}

/// As `sum`, with the gradient: what one process adds changes the losses of all.
torch::Tensor differentiable_sum(const torch::Tensor& x, const ProcessSum& sum) {
  const torch::Tensor detached = x.detach();
  const torch::Tensor total = sum(detached) + (x - detached);  // the second part is exactly 0
  if (total.requires_grad()) total.register_hook([sum](torch::Tensor grad) { return sum(grad); });
  return total;
}

}  // namespace

BatchNormImpl::BatchNormImpl(std::int64_t channels, std::int64_t levels)
    : weight_(register_parameter("weight", torch::ones({channels}))),
      bias_(register_parameter("bias", torch::zeros({channels}))),
      mean_(register_buffer("running_mean", torch::zeros(statistics_shape(channels, levels)))),
      variance_(register_buffer("running_var", torch::ones(statistics_shape(channels, levels)))),
      batches_(register_buffer("num_batches_tracked", torch::tensor(0, torch::kLong))) {}

torch::Tensor BatchNormImpl::forward(const torch::Tensor& x, std::int64_t level) {
  const torch::Tensor mean = has_levels() ? mean_[level] : mean_;
  const torch::Tensor variance = has_levels() ? variance_[level] : variance_;
  if (sum_ && is_training()) return shared_forward(x, mean, variance);
  if (is_training()) batches_ += 1;
  return torch::batch_norm(x, weight_, bias_, mean, variance, is_training(), kMomentum, kEpsilon,
                           at::globalContext().userEnabledCuDNN());
}

std::pair<torch::Tensor, torch::Tensor> BatchNormImpl::scale_and_shift() const {
  const torch::NoGradGuard no_grad;
  const torch::Tensor scale = weight_ / (variance_ + kEpsilon).sqrt();
  return {scale, bias_ - mean_ * scale};
}

/// @param running_mean, running_variance  brought up to date in place
torch::Tensor BatchNormImpl::shared_forward(const torch::Tensor& x, torch::Tensor running_mean,
                                            torch::Tensor running_variance) {
  const auto column = [](const torch::Tensor& values) { return values.view({1, -1, 1, 1}); };
  const torch::Tensor values = x.to(torch::kFloat);
  const torch::Tensor count = sum_(
      torch::full({1}, static_cast<double>(x.size(0) * x.size(2) * x.size(3)), values.options()));
  const torch::Tensor mean = differentiable_sum(values.sum({0, 2, 3}), sum_) / count;
  const torch::Tensor centered = values - column(mean);
  const torch::Tensor variance = differentiable_sum(centered.square().sum({0, 2, 3}), sum_) / count;
  {
    const torch::NoGradGuard no_grad;
    running_mean.lerp_(mean, kMomentum);
    running_variance.lerp_(variance * count / (count - 1), kMomentum);
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
