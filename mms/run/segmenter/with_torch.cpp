#include "mms/run/segmenter/torch_backend.hpp"
#include "mms/segmentation/network/torch_detector.hpp"

namespace mms {

bool torch_has_gpu() {
  return network::has_gpu();
}

std::unique_ptr<Detector> make_torch_detector(const SegmentationModel& model,
                                              const std::string& where,
                                              const SegmentationConfig& config) {
  return std::make_unique<network::TorchDetector>(model, where, config.decoder, config.threads);
}

}  // namespace mms
