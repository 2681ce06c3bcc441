#pragma once

#include <torch/nn/module.h>
#include <torch/nn/pimpl.h>

#include <cstdint>
#include <functional>
#include <utility>

namespace mms::network {

/// The sum of a tensor over all processes of a training; every process gets the same.
using ProcessSum = std::function<torch::Tensor(const torch::Tensor&)>;

/// Batch norm as torch's BatchNorm2d with its default options, with the same names of parameters
/// and statistics. In training also over a batch that is divided among processes.
class BatchNormImpl : public torch::nn::Module {
 public:
  explicit BatchNormImpl(std::int64_t channels);

  /// @param x  (B, C, H, W)
  torch::Tensor forward(const torch::Tensor& x);

  /// From now on the statistics are those of the images of all processes.
  void share(ProcessSum sum) { sum_ = std::move(sum); }

  /// Factor and summand, (C) each, that are the norm outside of training.
  std::pair<torch::Tensor, torch::Tensor> scale_and_shift() const;

 private:
  torch::Tensor shared_forward(const torch::Tensor& x);

  torch::Tensor weight_;
  torch::Tensor bias_;
  torch::Tensor mean_;      ///< running
  torch::Tensor variance_;  ///< running
  torch::Tensor batches_;   ///< number of batches so far
  ProcessSum sum_;
};
TORCH_MODULE(BatchNorm);

/// Makes all batch norms below the module use the images of all processes.
void share_statistics(torch::nn::Module& module, const ProcessSum& sum);

}  // namespace mms::network
