#include "mms/segmentation/network/inference.hpp"

#include "tests/network/torch_test.hpp"

namespace mms::network {
namespace {

/// Expects a map to have the values of the first image of a tensor (N x C x H x W).
void expect_map(const ChannelsLastMap& map, const torch::Tensor& tensor) {
  ASSERT_GE(map.pitch, tensor.size(1));
  const int columns = static_cast<int>(tensor.size(3));
  for (int c = 0; c < tensor.size(1); ++c) {
    for (int y = 0; y < tensor.size(2); ++y) {
      for (int x = 0; x < columns; ++x) {
        EXPECT_EQ(map.cell(y * columns + x)[c], tensor[0][c][y][x].item<float>());
      }
    }
  }
}

/// Output of a head; the grid of each level is one cell smaller, down to one.
HeadOutput random_output(int batch, int classes, int channels) {
  HeadOutput output;
  for (std::size_t i = 0; i < output.categories.size(); ++i) {
    const auto side = static_cast<std::int64_t>(output.categories.size() - i);
    output.categories[i] = torch::randn({batch, classes, side, side});
    output.kernels[i] = torch::randn({batch, channels, side, side});
  }
  output.mask_features = torch::randn({batch, channels, 6, 7});
  return output;
}

/// Checks the maps of a copy of `output`.
void expect_maps(const HeadOutput& output) {
  HeadOutput replaced = output;
  const HeadMaps maps = head_maps(replaced);
  for (std::size_t i = 0; i < output.categories.size(); ++i) {
    expect_map(maps.categories[i], output.categories[i]);
    expect_map(maps.kernels[i], output.kernels[i]);
  }
  expect_map(maps.mask_features, output.mask_features);
  EXPECT_EQ(maps.mask_height, 6);
  EXPECT_EQ(maps.mask_width, 7);
}

TEST(HeadMaps, EqualTensorsOfAnyLayout) {
  torch::manual_seed(1);
  for (const int batch : {1, 2}) {
    for (const int classes : {1, 2}) {  // one channel has both layouts simultaneously
      HeadOutput output = random_output(batch, classes, 4);
      expect_maps(output);
      for (std::size_t i = 0; i < output.categories.size(); ++i) {
        output.categories[i] = output.categories[i].contiguous(at::MemoryFormat::ChannelsLast);
        output.kernels[i] = output.kernels[i].transpose(2, 3);
      }
      output.mask_features = output.mask_features.to(torch::kDouble).to(torch::kFloat);
      expect_maps(output);
    }
  }
}

TEST(HeadMaps, EqualSlices) {
  torch::manual_seed(2);
  HeadOutput output = random_output(1, 2, 4);
  for (std::size_t i = 0; i < output.categories.size(); ++i) {
    const torch::Tensor both = torch::cat({output.kernels[i], output.categories[i]}, 1);
    output.kernels[i] = both.slice(1, 0, 4);
    output.categories[i] = both.slice(1, 4, 5);
  }
  expect_maps(output);
}

}  // namespace
}  // namespace mms::network
