#pragma once

#include <vector>

#include "mms/segmentation/engine/tensor.hpp"

namespace mms::engine {

// Network operations other than convolutions, on maps of any format. They compute in float32 with
// OpenMP's number of threads.

/// Resizes maps.
class Resizer {
 public:
  Resizer(const Resizing& resizing, const Shape& from, const Shape& to);

  /// @param addend  with y's shape, or null
  void run(const Tensor& x, const Tensor* addend, const Tensor& y) const;

 private:
  /// Two adjacent rows or columns and the weight of the second.
  struct Neighbours {
    int first = 0;
    int second = 0;
    float share = 0.0F;
  };

  static Neighbours bilinear(int i, int from, int to);
  static Neighbours nearest(int i, int from, int to);

  std::vector<Neighbours> rows_;
  std::vector<Neighbours> columns_;
};

void concatenate(const std::vector<Tensor>& parts, const Tensor& y);

/// @param residual  with y's shape, or null
void add_global_context(const GlobalContext& context, const Tensor& x, const Tensor* residual,
                        const Tensor& y);

/// @param scratch  as many as x's pixels
void compute_gate(const Gate& gate, const Tensor& x, std::vector<float>& scratch, const Tensor& y);

/// @param gate  float32
void blend(const Tensor& a, const Tensor& b, const Tensor& gate, const Tensor& y);

void compute_global_branch(const GlobalBranch& branch, const Tensor& x, const Tensor& y);

void normalise_groups(const GroupNorm& norm, const Tensor& x, const Tensor& y);

void convert(const Tensor& x, const Tensor& y);

}  // namespace mms::engine
