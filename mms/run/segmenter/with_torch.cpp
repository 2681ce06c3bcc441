#include "mms/run/segmenter/torch_backend.hpp"
#include "mms/segmentation/network/torch_detector.hpp"

namespace mms {
namespace {

std::unique_ptr<Detector> make_detector(const SegmentationModel& model, const std::string& where,
                                        const SegmentationConfig& config) {
  return std::make_unique<network::TorchDetector>(model, where, config.decoder, config.threads);
}

/// Before main, in every program with this file.
[[maybe_unused]] const bool kIsSet = [] {
  torch_backend() = {&network::has_gpu, &make_detector};
  return true;
}();

}  // namespace
}  // namespace mms
