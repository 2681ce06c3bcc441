#include "mms/segmentation/engine/quantization.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mms/core/error.hpp"
#include "mms/segmentation/engine/calibration/magnitude_histogram.hpp"
#include "mms/segmentation/engine/calibration/range_calibration.hpp"
#include "mms/segmentation/engine/graph/network_graph.hpp"
#include "mms/segmentation/weights/int8_weights.hpp"
#include "tests/engine/engine_test_support.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms::engine {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::random_image;
using testing::random_model;

TEST(MagnitudeHistogram, KeepsFullRangeOfUniformValues) {
  MagnitudeHistogram histogram;
  std::vector<float> values;
  for (int i = -1000; i <= 1000; ++i) values.push_back(static_cast<float>(i) * 0.003F);
  histogram.add(values.data(), static_cast<int>(values.size()));
  EXPECT_NEAR(histogram.best_range(127), 3.0F, 0.05F);
}

/// Sum of the squared errors of values quantized in `levels` steps up to a range.
double stored_error(const std::vector<float>& values, float range, int levels) {
  const float step = range / static_cast<float>(levels);
  double sum = 0.0;
  for (const float value : values) {
    const float stored = std::nearbyint(std::clamp(value, -range, range) / step) * step;
    sum += std::pow(static_cast<double>(stored - value), 2);
  }
  return sum;
}

TEST(MagnitudeHistogram, MinimizesQuantizationError) {
  for (const float outlier : {5.0F, 12.0F, 60.0F}) {
    std::vector<float> values = testing::random_numbers(100000, 1.0F, 1);
    values.push_back(outlier);
    MagnitudeHistogram histogram;
    histogram.add(values.data(), static_cast<int>(values.size()));
    const double error = stored_error(values, histogram.best_range(127), 127);
    for (float range = 1.0F; range <= outlier; range *= 1.1F) {
      EXPECT_LE(error, 1.05 * stored_error(values, range, 127)) << outlier << ", " << range;
    }
  }
}

TEST(MagnitudeHistogram, HasRangeWithoutValues) {
  EXPECT_GT(MagnitudeHistogram().best_range(127), 0.0F);
}

TEST(Quantization, RoundTripsThroughMetadata) {
  Quantization quantization;
  quantization.ranges = {{"backbone.conv1", 3.25F}, {"mask_head.conv 2", 1e-3F}};
  quantization.float_layers = {"a.b", "c.d"};
  Weights weights;
  weights.metadata["quantization.range.gone"] = "7";
  weights.metadata["other"] = "stays";
  pack_quantization(quantization, weights);
  const Quantization read = unpack_quantization(weights, "file");
  EXPECT_EQ(read.ranges, quantization.ranges);
  EXPECT_EQ(read.float_layers, quantization.float_layers);
  EXPECT_EQ(weights.metadata.at("other"), "stays");
}

TEST(Quantization, RejectsInvalidRanges) {
  for (const char* bad : {"", "x", "-1", "0", "nan", "inf", "1x"}) {
    Weights weights;
    weights.metadata["quantization.range.image"] = bad;
    const std::string message =
        message_of<DataError>([&] { unpack_quantization(weights, "net.file"); });
    expect_in("net.file", message);
    expect_in("quantization.range.image", message);
    expect_in("positive number", message);
  }
}

TEST(Quantization, RejectsOtherNetwork) {
  const SegmentationModel model = random_model({}, 1);
  Calibration calibration(model, "net");
  calibration.add(random_image(96, 96, 1));
  const auto error = [&](const Quantization& quantization) {
    return message_of<DataError>(
        [&] { NetworkEngine(model, "net.file", quantization).run(random_image(96, 96, 1)); });
  };
  Quantization more = calibration.quantization({});
  more.ranges["no such value"] = 1.0F;
  expect_in("net.file: has an int8 range for 'no such value'", error(more));
  Quantization less = calibration.quantization({});
  less.ranges.erase("neck.fpn_convs.0.conv");
  expect_in("net.file: has no range for the value 'neck.fpn_convs.0.conv'", error(less));
}

class QuantizedNetwork : public ::testing::TestWithParam<NetworkVariant> {};

TEST_P(QuantizedNetwork, StaysCloseToFloat) {
  const NetworkConfig config = NetworkConfig::preset(NetworkSize::kNano, GetParam());
  const SegmentationModel model = random_model(config, 1);
  Calibration calibration(model, "net");
  for (unsigned i = 0; i < 3; ++i) calibration.add(random_image(96, 128, i));
  const Quantization quantization = calibration.quantization({});
  const std::vector<PreparedImage> images = {random_image(96, 128, 10), random_image(128, 96, 11)};
  const double error = output_error(model, "net", quantization, images);
  EXPECT_GT(error, 1e-5);
  EXPECT_LT(error, 0.15);
}

TEST_P(QuantizedNetwork, IsExactWithAllFloatLayers) {
  const NetworkConfig config = NetworkConfig::preset(NetworkSize::kNano, GetParam());
  const SegmentationModel model = random_model(config, 1);
  Calibration calibration(model, "net");
  calibration.add(random_image(96, 96, 1));
  std::set<std::string> all;
  const auto note = [&](int, int) { return true; };
  const std::vector<PreparedImage> images = {random_image(96, 96, 2)};
  for (const auto& [layer, error] :
       layer_sensitivities(model, "net", calibration.quantization({}), images, note)) {
    EXPECT_LT(error, 0.1) << layer;
    all.insert(layer);
  }
  EXPECT_EQ(output_error(model, "net", calibration.quantization(all), images), 0.0);
}

/// The weights of a layer in int8.
std::vector<float> bytes_of(const ConvLayer& layer) {
  Weights weights;
  weights.tensors["w"] = {{layer.out, layer.inputs_per_output()}, layer.weight};
  return to_bytes(std::move(weights), {"w"}).tensors.at("w").values;
}

TEST_P(QuantizedNetwork, SameInt8WeightsFromStoredInt8) {
  const NetworkConfig config = NetworkConfig::preset(NetworkSize::kNano, GetParam());
  const SegmentationModel model = random_model(config, 1);
  const std::string exact_layer = "neck.fpn_convs.0.conv";
  const Weights bytes = weights_in_bytes(model, {{}, {exact_layer}});
  EXPECT_FALSE(bytes.tensors.contains(exact_layer + ".weight_scale"));
  LayerReader layers(model.weights);
  LayerReader stored(from_bytes(bytes, "net"));
  const Graph graph = network_graph(config, layers, 96, 96);
  const Graph again = network_graph(config, stored, 96, 96);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const auto* node = std::get_if<Convolution>(&graph.nodes[i].operation);
    if (node == nullptr) continue;
    const ConvLayer& layer = *node->layer;
    const ConvLayer& other = *std::get<Convolution>(again.nodes[i].operation).layer;
    if (layer.name == exact_layer) {
      EXPECT_EQ(layer.weight, other.weight);
    } else if (!layer.name.ends_with(".large")) {  // the sum of two tensors, rounded once more
      const std::vector<float> expected = bytes_of(layer);
      const std::vector<float> found = bytes_of(other);
      std::size_t different = 0;  // at the center between two numbers
      for (std::size_t k = 0; k < expected.size(); ++k) {
        different += expected[k] == found[k] ? 0 : 1;
        ASSERT_NEAR(expected[k], found[k], 1.0F) << layer.name;
      }
      EXPECT_LT(different, 1 + expected.size() / 1000) << layer.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllVariants, QuantizedNetwork,
                         ::testing::Values(NetworkVariant::kSolov2, NetworkVariant::kRfp,
                                           NetworkVariant::kSac, NetworkVariant::kDetectors));

}  // namespace
}  // namespace mms::engine
