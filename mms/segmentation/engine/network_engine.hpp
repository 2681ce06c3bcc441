#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mms/segmentation/engine/graph/layer_reader.hpp"
#include "mms/segmentation/engine/plan.hpp"
#include "mms/segmentation/engine/quantization.hpp"
#include "mms/segmentation/solo/prepared_image.hpp"
#include "mms/segmentation/solo/solo_decoder.hpp"
#include "mms/segmentation/weights/model.hpp"

namespace mms::engine {

/// A trained network on the CPU without libtorch: oneDNN convolutions in float32 or int8.
class NetworkEngine {
 public:
  /// @param where  name of the model in messages, such as the file name
  /// @throws DataError if the weights do not fit the network, or it has deformable convolutions.
  NetworkEngine(SegmentationModel model, const std::string& where, Quantization quantization);

  /// The head's maps of an image, valid until the next call. Keeps the plans of the latest input
  /// sizes.
  HeadMaps run(const PreparedImage& image, const Plan::Observer& observer = {});

  const NetworkConfig& config() const { return config_; }
  const std::vector<std::string>& classes() const { return classes_; }

 private:
  Plan& plan_for(int height, int width);

  static constexpr std::size_t kMaxPlans = 4;

  NetworkConfig config_;
  std::vector<std::string> classes_;
  std::string where_;
  Quantization quantization_;
  LayerReader layers_;
  ConvolutionLibrary library_;
  std::vector<std::unique_ptr<Plan>> plans_;  ///< most recently used first
};

}  // namespace mms::engine
