#include "mms/run/segmenter/torch_backend.hpp"

#include "mms/core/error.hpp"

namespace mms {

TorchBackend& torch_backend() {
  static TorchBackend backend;
  return backend;
}

bool torch_has_gpu() {
  return torch_backend().has_gpu != nullptr && torch_backend().has_gpu();
}

std::unique_ptr<Detector> make_torch_detector(const SegmentationModel& model,
                                              const std::string& where,
                                              const SegmentationConfig& config) {
  if (torch_backend().make_detector == nullptr) {
    throw Error(where, "requires libtorch, which is not part of this program",
                "use mms-torch with the same arguments, or segmentation.backend: auto");
  }
  return torch_backend().make_detector(model, where, config);
}

}  // namespace mms
