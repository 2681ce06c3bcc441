#pragma once

#include <torch/types.h>

#include <gtest/gtest.h>

namespace mms::testing {

/// Fails unless two tensors have one shape and differ by at most `tolerance` anywhere.
inline void expect_close(const torch::Tensor& actual, const torch::Tensor& expected,
                         double tolerance) {
  ASSERT_EQ(actual.sizes(), expected.sizes());
  EXPECT_LE((actual - expected).abs().max().item<double>(), tolerance);
}

}  // namespace mms::testing
