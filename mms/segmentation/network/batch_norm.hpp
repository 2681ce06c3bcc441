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
/// and statistics. In training also over a batch that is divided among processes. Where a layer is
/// shared by the levels of a pyramid, these can have statistics of their own: in training each is
/// normalized with its own batch, too.
class BatchNormImpl : public torch::nn::Module {
 public:
  /// @param levels  with statistics of their own; 0: one for all
  explicit BatchNormImpl(std::int64_t channels, std::int64_t levels = 0);

  /// @param x      (B, C, H, W)
  /// @param level  of the pyramid
  torch::Tensor forward(const torch::Tensor& x, std::int64_t level = 0);

  /// Whether levels have statistics of their own.
  bool has_levels() const { return mean_.dim() == 2; }

  /// From now on the statistics are those of the images of all processes.
  void share(ProcessSum sum) { sum_ = std::move(sum); }

  /// Factor and summand, (C) each, that are the norm outside of training; not of levels.
  std::pair<torch::Tensor, torch::Tensor> scale_and_shift() const;

 private:
  torch::Tensor shared_forward(const torch::Tensor& x, torch::Tensor running_mean,
                               torch::Tensor running_variance);

  torch::Tensor weight_;
  torch::Tensor bias_;
  torch::Tensor mean_;      ///< running, (C) or (levels, C)
  torch::Tensor variance_;  ///< the same
  torch::Tensor batches_;   ///< number of batches so far
  ProcessSum sum_;
};
TORCH_MODULE(BatchNorm);

/// Makes all batch norms below the module use the images of all processes.
void share_statistics(torch::nn::Module& module, const ProcessSum& sum);

}  // namespace mms::network
