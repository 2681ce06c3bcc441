#pragma once

#include "mms/segmentation/detection/detector.hpp"
#include "mms/segmentation/network/solo_network.hpp"
#include "mms/segmentation/weights/model.hpp"

namespace mms::network {

/// A trained network in libtorch: on the GPU if available, else on the CPU in float32 with batch
/// norm folded into the convolutions.
class TorchDetector : public Detector {
 public:
  /// @param where    name of the model in messages, such as the file name
  /// @param threads  of libtorch, for the whole program; 0: one per core
  /// @throws DataError if the weights do not fit the network.
  TorchDetector(const SegmentationModel& model, const std::string& where,
                const DecoderConfig& config, int threads);

  std::vector<Detection> detect(const Image<Rgb>& image) override;
  const std::vector<std::string>& classes() const override { return classes_; }

 private:
  SoloNetwork network_;
  std::vector<std::string> classes_;
  DecoderConfig config_;
};

/// Whether libtorch finds a GPU.
bool has_gpu();

}  // namespace mms::network
