#include "mms/segmentation/weights/int8_weights.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;

/// Two output channels, the second one all zeros.
Weights sample_weights() {
  Weights weights;
  weights.metadata["kept"] = "yes";
  weights.tensors["a.weight"] = {{2, 3}, {-0.5F, 0.126F, 0.25F, 0.0F, 0.0F, 0.0F}};
  weights.tensors["b.weight"] = {{1, 1}, {0.3F}};
  return weights;
}

TEST(Int8Weights, AreIntegerMultiplesOfStep) {
  const Weights bytes = to_bytes(sample_weights(), {"a.weight"});
  EXPECT_EQ(bytes.tensors.at("a.weight").values,
            (std::vector{-127.0F, 32.0F, 64.0F, 0.0F, 0.0F, 0.0F}));
  EXPECT_EQ(bytes.tensors.at("a.weight_scale"), (WeightTensor{{2}, {0.5F / 127.0F, 0.0F}}));
  EXPECT_EQ(bytes.tensors.at("b.weight"), sample_weights().tensors.at("b.weight"));
}

TEST(Int8Weights, RoundTripWithinHalfAStep) {
  const Weights back = from_bytes(to_bytes(sample_weights(), {"a.weight"}), "file");
  EXPECT_EQ(back.metadata, sample_weights().metadata);
  EXPECT_EQ(back.tensors.size(), 2U);
  const std::vector<float>& values = back.tensors.at("a.weight").values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i], sample_weights().tensors.at("a.weight").values[i], 0.25 / 127.0 + 1e-7);
  }
  EXPECT_EQ(to_bytes(back, {"a.weight"}), to_bytes(sample_weights(), {"a.weight"}));
}

TEST(Int8Weights, ErrorsNameTensor) {
  const auto error = [](const std::string& name, const WeightTensor& steps) {
    Weights weights = to_bytes(sample_weights(), {"a.weight"});
    weights.tensors[name] = steps;
    return message_of<DataError>([&] { from_bytes(weights, "file"); });
  };
  expect_in("file: has 'c.weight_scale' but no tensor 'c.weight'",
            error("c.weight_scale", {{1}, {1.0F}}));
  expect_in("file: 'a.weight_scale' has 3 steps, expected one for each output channel",
            error("a.weight_scale", {{3}, {1.0F, 1.0F, 1.0F}}));
  expect_in("'a.weight' is too large for a float", error("a.weight_scale", {{2}, {3e38F, 1.0F}}));
  expect_in("one for each output channel of 'a.weight'", error("a.weight_scale", {{}, {1.0F}}));
}

}  // namespace
}  // namespace mms
