#include "mms/segmentation/engine/convolution_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/engine_test_support.hpp"

namespace mms::engine {
namespace {

using testing::OwnTensor;
using testing::random_numbers;

struct Case {
  ConvLayer layer;
  int height = 0;
  int width = 0;
  bool residual = false;
};

ConvLayerPtr with_weights(ConvLayer layer) {
  layer.weight =
      random_numbers(static_cast<std::size_t>(layer.out * layer.inputs_per_output()), 0.2F, 5);
  layer.bias = random_numbers(static_cast<std::size_t>(layer.out), 0.3F, 6);
  return std::make_shared<ConvLayer>(std::move(layer));
}

/// The definition, with a loop for every sum.
std::vector<float> convolved(const ConvLayer& layer, const std::vector<float>& weight,
                             const Shape& in, const std::vector<float>& x, const Shape& out,
                             const std::vector<float>& residual) {
  const int pad = layer.dilation * (layer.kernel / 2);
  std::vector<float> y;
  for (int row = 0; row < out.height; ++row) {
    for (int column = 0; column < out.width; ++column) {
      for (int o = 0; o < out.channels; ++o) {
        double sum = static_cast<double>(layer.bias[static_cast<std::size_t>(o)]);
        for (int i = 0; i < in.channels; ++i) {
          for (int ky = 0; ky < layer.kernel; ++ky) {
            for (int kx = 0; kx < layer.kernel; ++kx) {
              const int from_y = row * layer.stride + ky * layer.dilation - pad;
              const int from_x = column * layer.stride + kx * layer.dilation - pad;
              if (from_y < 0 || from_x < 0 || from_y >= in.height || from_x >= in.width) continue;
              const auto w = static_cast<std::size_t>(
                  ((o * in.channels + i) * layer.kernel + ky) * layer.kernel + kx);
              const auto p =
                  static_cast<std::size_t>((from_y * in.width + from_x) * in.channels + i);
              sum += static_cast<double>(weight[w]) * static_cast<double>(x[p]);
            }
          }
        }
        if (!residual.empty()) sum += static_cast<double>(residual[y.size()]);
        y.push_back(static_cast<float>(layer.relu ? std::max(sum, 0.0) : sum));
      }
    }
  }
  return y;
}

Shape output_shape(const Case& c) {
  const auto strided = [&](int n) { return (n + c.layer.stride - 1) / c.layer.stride; };
  return {strided(c.height), strided(c.width), c.layer.out};
}

std::vector<Case> cases() {
  return {
      {{.in = 3, .out = 16, .kernel = 7, .stride = 2, .relu = true}, 32, 24, false},
      {{.in = 66, .out = 32, .kernel = 3, .relu = true}, 9, 11, false},
      {{.in = 32, .out = 32, .kernel = 3, .relu = true}, 8, 10, true},
      {{.in = 32, .out = 24, .kernel = 3, .dilation = 3}, 12, 10, false},
      {{.in = 16, .out = 16, .kernel = 3, .stride = 2, .dilation = 3}, 16, 12, false},
      {{.in = 64, .out = 32, .kernel = 1, .stride = 2}, 8, 12, false},
      {{.in = 128, .out = 2, .kernel = 3}, 7, 7, false},
      {{.in = 32, .out = 64, .kernel = 1}, 6, 6, true},
  };
}

TEST(ConvolutionKernel, EqualsDefinition) {
  ConvolutionLibrary library;
  for (const Case& c : cases()) {
    const ConvLayerPtr layer = with_weights(c.layer);
    const Shape in = {c.height, c.width, c.layer.in};
    const Shape out = output_shape(c);
    const OwnTensor x(in, random_numbers(static_cast<std::size_t>(in.count()), 1.0F, 7));
    const auto residual = c.residual
                              ? random_numbers(static_cast<std::size_t>(out.count()), 1.0F, 8)
                              : std::vector<float>{};
    const OwnTensor y(out);
    if (c.residual) store(y.tensor, {0, out.pixels()}, residual.data());
    ConvolutionKernel kernel(library, layer, x.tensor, y.tensor,
                             c.residual ? std::optional<Format>(Format{}) : std::nullopt);
    kernel.run(library.stream());
    library.stream().wait();
    const auto expected = convolved(*layer, layer->weight, in, x.values(), out, residual);
    const auto actual = y.values();
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_NEAR(actual[i], expected[i], 1e-3F) << i;
  }
}

/// The weights after quantization to int8.
std::vector<float> stored_weights(const ConvLayer& layer, const std::vector<float>& scales) {
  std::vector<float> weight = layer.weight;
  const auto count = static_cast<std::size_t>(layer.inputs_per_output());
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const float scale = scales[i / count];
    weight[i] = std::nearbyint(weight[i] / scale) * scale;
  }
  return weight;
}

/// Without these instructions, oneDNN adds two products in 16 bits, which saturate.
bool has_exact_int8() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512vnni");
#else
  return true;
#endif
}

TEST(ConvolutionKernel, Int8RoundsOnlyOutput) {
  if (!has_exact_int8()) GTEST_SKIP() << "needs AVX-512 VNNI";
  ConvolutionLibrary library;
  for (const Number number : {Number::kUnsigned8, Number::kSigned8}) {
    for (const Case& c : cases()) {
      const ConvLayerPtr layer = with_weights(c.layer);
      const Shape in = {c.height, c.width, c.layer.in};
      const Shape out = output_shape(c);
      std::vector<float> values = random_numbers(static_cast<std::size_t>(in.count()), 1.0F, 7);
      const OwnTensor x(in, values, {number, 0.02F});
      const Format format = byte_format(8.0F, c.layer.relu);
      const Format residual_format = {Number::kSigned8, 0.03F};
      const OwnTensor residual(out, random_numbers(static_cast<std::size_t>(out.count()), 1.0F, 8),
                               residual_format);
      const OwnTensor y(out, format);
      if (c.residual) {
        std::copy_n(residual.tensor.data, static_cast<std::size_t>(out.count()), y.tensor.data);
      }
      ConvolutionKernel kernel(library, layer, x.tensor, y.tensor,
                               c.residual ? std::optional(residual_format) : std::nullopt);
      kernel.run(library.stream());
      library.stream().wait();
      const auto expected =
          convolved(*layer, stored_weights(*layer, library.weight_scales(layer)), in, x.values(),
                    out, c.residual ? residual.values() : std::vector<float>{});
      const auto actual = y.values();
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const bool positive = c.layer.relu;
        const float limited = std::clamp(expected[i], format.scale * (positive ? 0.0F : -128.0F),
                                         format.scale * (positive ? 255.0F : 127.0F));
        ASSERT_NEAR(actual[i], limited, 0.51F * format.scale + 1e-4F) << i;
      }
    }
  }
}

TEST(ConvolutionLibrary, KeepsOneCopyOfEqualWeights) {
  ConvolutionLibrary library;
  const ConvLayerPtr layer = with_weights({.in = 16, .out = 16, .kernel = 3});
  const dnnl::memory::desc plain({16, 16, 3, 3}, dnnl::memory::data_type::f32,
                                 dnnl::memory::format_tag::oihw);
  EXPECT_EQ(library.packed(layer, plain).get_data_handle(),
            library.packed(layer, plain).get_data_handle());
}

}  // namespace
}  // namespace mms::engine
