#include "mms/segmentation/network/inference.hpp"

#include <c10/core/InferenceMode.h>

#include "mms/segmentation/solo/prepared_image.hpp"

namespace mms::network {
namespace {

/// The first image's map; `tensor` is replaced by the tensor that owns its data.
ChannelsLastMap channels_last(torch::Tensor& tensor) {
  // For a map with one channel or one pixel both layouts are contiguous and equal.
  tensor = tensor.to(torch::kCPU, torch::kFloat).contiguous(at::MemoryFormat::ChannelsLast);
  return {tensor.data_ptr<float>(), static_cast<int>(tensor.size(1))};
}

}  // namespace

HeadMaps head_maps(HeadOutput& output) {
  HeadMaps maps;
  for (std::size_t i = 0; i < output.categories.size(); ++i) {
    maps.categories[i] = channels_last(output.categories[i]);
    maps.kernels[i] = channels_last(output.kernels[i]);
  }
  maps.mask_features = channels_last(output.mask_features);
  maps.mask_height = static_cast<int>(output.mask_features.size(2));
  maps.mask_width = static_cast<int>(output.mask_features.size(3));
  return maps;
}

std::vector<Detection> detect(SoloNetwork& network, const Image<Rgb>& image,
                              const DecoderConfig& config) {
  const c10::InferenceMode inference;
  PreparedImage prepared = prepare_image(image, network->config());
  const torch::Tensor input =
      torch::from_blob(prepared.planes.data(), {1, 3, prepared.height, prepared.width},
                       torch::kFloat)
          .to(network->parameters().front().device())
          .contiguous(at::MemoryFormat::ChannelsLast);
  HeadOutput output = network->forward(input);
  return decode(head_maps(output), network->config(), prepared, config);
}

}  // namespace mms::network
