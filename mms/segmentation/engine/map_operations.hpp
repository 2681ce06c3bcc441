#pragma once

#include <vector>

#include "mms/segmentation/engine/tensor.hpp"

namespace mms::engine {

// The operations of a network that are no convolutions, on maps of any format. They compute in
// float32 and use as many threads as OpenMP is set to.

/// Scales maps of one size to another.
class Resizer {
 public:
  Resizer(const Resizing& resizing, const Shape& from, const Shape& to);

  /// @param addend  of y's shape, or null
  void run(const Tensor& x, const Tensor* addend, const Tensor& y) const;

 private:
  /// Two neighbouring rows or columns and how much the second counts.
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

/// @param residual  of y's shape, or null
void add_global_context(const GlobalContext& context, const Tensor& x, const Tensor* residual,
                        const Tensor& y);

/// @param scratch  of x's number of pixels
void compute_gate(const Gate& gate, const Tensor& x, std::vector<float>& scratch, const Tensor& y);

/// @param gate  float32
void blend(const Tensor& a, const Tensor& b, const Tensor& gate, const Tensor& y);

void compute_global_branch(const GlobalBranch& branch, const Tensor& x, const Tensor& y);

void normalise_groups(const GroupNorm& norm, const Tensor& x, const Tensor& y);

void convert(const Tensor& x, const Tensor& y);

}  // namespace mms::engine
