#include "mms/segmentation/engine/map_operations.hpp"

#include <gtest/gtest.h>

#include "tests/engine/engine_test_support.hpp"

namespace mms::engine {
namespace {

using testing::OwnTensor;
using testing::random_numbers;

std::vector<float> numbers(const Shape& shape, unsigned seed) {
  return random_numbers(static_cast<std::size_t>(shape.count()), 1.0F, seed);
}

ConvLayerPtr pointwise(std::vector<float> weight, std::vector<float> bias) {
  ConvLayer layer{.name = "layer"};
  layer.out = static_cast<int>(bias.size());
  layer.in = static_cast<int>(weight.size() / bias.size());
  layer.weight = std::move(weight);
  layer.bias = std::move(bias);
  return std::make_shared<ConvLayer>(std::move(layer));
}

TEST(Resizer, DoublesRowAsLibtorch) {
  const OwnTensor x({1, 2, 1}, {0.0F, 4.0F});
  const OwnTensor y({1, 4, 1});
  Resizer({.bilinear = true}, x.tensor.shape, y.tensor.shape).run(x.tensor, nullptr, y.tensor);
  EXPECT_EQ(y.values(), (std::vector<float>{0.0F, 1.0F, 3.0F, 4.0F}));
}

TEST(Resizer, KeepsMapOfEqualSize) {
  const Shape shape = {5, 7, 66};
  const OwnTensor x(shape, numbers(shape, 1));
  const OwnTensor y(shape);
  for (const bool bilinear : {false, true}) {
    Resizer({bilinear}, shape, shape).run(x.tensor, nullptr, y.tensor);
    EXPECT_EQ(y.values(), x.values());
  }
}

TEST(Resizer, RepeatsNearestAndAdds) {
  const OwnTensor x({1, 2, 2}, {1.0F, 2.0F, 3.0F, 4.0F});
  const OwnTensor addend({2, 4, 2}, std::vector<float>(16, 10.0F));
  const OwnTensor y({2, 4, 2});
  Resizer({.bilinear = false}, x.tensor.shape, y.tensor.shape)
      .run(x.tensor, &addend.tensor, y.tensor);
  EXPECT_EQ(y.at(0, 0, 0), 11.0F);
  EXPECT_EQ(y.at(1, 1, 1), 12.0F);
  EXPECT_EQ(y.at(0, 2, 0), 13.0F);
  EXPECT_EQ(y.at(1, 3, 1), 14.0F);
}

TEST(Resizer, KeepsPlaneInside) {
  const Shape from = {8, 8, 1};
  std::vector<float> plane;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x)
      plane.push_back(2.0F * static_cast<float>(x) - static_cast<float>(y));
  }
  const OwnTensor x(from, plane);
  const OwnTensor y({20, 20, 1});
  Resizer({.bilinear = true}, from, y.tensor.shape).run(x.tensor, nullptr, y.tensor);
  for (int row = 3; row < 17; ++row) {
    for (int column = 3; column < 17; ++column) {
      const float at_x = (static_cast<float>(column) + 0.5F) * 0.4F - 0.5F;
      const float at_y = (static_cast<float>(row) + 0.5F) * 0.4F - 0.5F;
      EXPECT_NEAR(y.at(row, column, 0), 2.0F * at_x - at_y, 1e-5F);
    }
  }
}

TEST(Concatenation, ConcatenatesChannels) {
  const Shape a = {3, 4, 2};
  const Shape b = {3, 4, 3};
  const OwnTensor first(a, numbers(a, 2));
  const OwnTensor second(b, numbers(b, 3));
  const OwnTensor y({3, 4, 5});
  concatenate({first.tensor, second.tensor}, y.tensor);
  EXPECT_EQ(y.at(2, 1, 1), first.at(2, 1, 1));
  EXPECT_EQ(y.at(2, 1, 2), second.at(2, 1, 0));
  EXPECT_EQ(y.at(0, 3, 4), second.at(0, 3, 2));
}

TEST(GlobalContextOperation, AddsLayerOfMeanScalesAndLimits) {
  const OwnTensor x({1, 2, 2}, {1.0F, -2.0F, 3.0F, -4.0F});  // mean (2, -3)
  const OwnTensor residual({1, 2, 2}, {0.0F, 0.0F, 0.0F, 100.0F});
  const OwnTensor y({1, 2, 2});
  GlobalContext context{.layer = pointwise({1.0F, 0.0F, 0.0F, 2.0F}, {0.5F, 0.0F}),
                        .scale = {2.0F, 1.0F},
                        .shift = {0.0F, 1.0F},
                        .relu = true};
  add_global_context(context, x.tensor, &residual.tensor, y.tensor);
  // Added: (2.5, -6). First channel 2 (x + 2.5), second x - 6 + 1.
  EXPECT_EQ(y.values(), (std::vector<float>{7.0F, 0.0F, 11.0F, 91.0F}));
}

TEST(GateOperation, AveragesMirroredBoxWithStride) {
  std::vector<float> values(25, 0.0F);
  values[0] = 25.0F;  // a corner: mirrored, it is itself once, its neighbours twice
  values[1] = 50.0F;
  const OwnTensor x({5, 5, 1}, values);
  const OwnTensor y({3, 3, 1});
  std::vector<float> scratch(25);
  compute_gate({.weight = {1.0F}, .bias = 0.0F, .box = 5, .stride = 2}, x.tensor, scratch,
               y.tensor);
  EXPECT_FLOAT_EQ(y.at(0, 0, 0), 1.0F + 2.0F * 2.0F);
  EXPECT_FLOAT_EQ(y.at(0, 1, 0), 1.0F + 2.0F);
  EXPECT_FLOAT_EQ(y.at(2, 2, 0), 0.0F);
}

TEST(GateOperation, WeightsChannelsThroughSigmoid) {
  const OwnTensor x({1, 1, 2}, {1.0F, 2.0F});
  const OwnTensor y({1, 1, 1});
  std::vector<float> scratch(1);
  compute_gate({.weight = {3.0F, -1.0F}, .bias = -1.0F, .sigmoid = true}, x.tensor, scratch,
               y.tensor);
  EXPECT_FLOAT_EQ(y.at(0, 0, 0), 0.5F);
}

TEST(Blend, MixesByGate) {
  const OwnTensor a({1, 2, 2}, {1.0F, 2.0F, 3.0F, 4.0F});
  const OwnTensor b({1, 2, 2}, {5.0F, 6.0F, 7.0F, 8.0F});
  const OwnTensor gate({1, 2, 1}, {1.0F, 0.25F});
  const OwnTensor y({1, 2, 2});
  blend(a.tensor, b.tensor, gate.tensor, y.tensor);
  EXPECT_EQ(y.values(), (std::vector<float>{1.0F, 2.0F, 6.0F, 7.0F}));
}

TEST(GlobalBranchOperation, IsConstantOverImage) {
  const OwnTensor x({1, 2, 1}, {1.0F, 3.0F});
  const OwnTensor y({1, 2, 2});
  compute_global_branch({pointwise({2.0F, -1.0F}, {1.0F, 0.0F})}, x.tensor, y.tensor);
  EXPECT_EQ(y.values(), (std::vector<float>{5.0F, 0.0F, 5.0F, 0.0F}));
}

TEST(GroupNormOperation, NormalizesEachGroupAndLimits) {
  const OwnTensor x({1, 2, 4}, {1.0F, 3.0F, 10.0F, 10.0F, 1.0F, 3.0F, 30.0F, 30.0F});
  const OwnTensor y({1, 2, 4});
  normalise_groups({.groups = 2, .gamma = {1, 1, 2, 1}, .beta = {0, 0, 0, 5}}, x.tensor, y.tensor);
  const std::vector<float> expected = {0.0F, 1.0F, 0.0F, 4.0F, 0.0F, 1.0F, 2.0F, 6.0F};
  const std::vector<float> actual = y.values();
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(actual[i], expected[i], 1e-4F) << i;
}

TEST(Conversion, RoundsToInt8AndLimits) {
  const OwnTensor x({1, 6, 1}, {-1000.0F, -0.76F, -0.2F, 0.26F, 1.0F, 1000.0F});
  const OwnTensor bytes({1, 6, 1}, Format{Number::kSigned8, 0.5F});
  convert(x.tensor, bytes.tensor);
  EXPECT_EQ(bytes.values(), (std::vector<float>{-63.5F, -1.0F, 0.0F, 0.5F, 1.0F, 63.5F}));
  const OwnTensor positive({1, 6, 1}, Format{Number::kUnsigned8, 0.5F});
  convert(x.tensor, positive.tensor);
  EXPECT_EQ(positive.values(), (std::vector<float>{0.0F, 0.0F, 0.0F, 0.5F, 1.0F, 127.5F}));
}

}  // namespace
}  // namespace mms::engine
