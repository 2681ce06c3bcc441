#include "mms/core/error.hpp"
#include "mms/run/segmenter/torch_backend.hpp"

namespace mms {

bool torch_has_gpu() {
  return false;
}

std::unique_ptr<Detector> make_torch_detector(const SegmentationModel&, const std::string& where,
                                              const SegmentationConfig&) {
  throw Error(where, "requires libtorch, which is not part of this program",
              "use mms-torch with the same arguments, or segmentation.backend: auto");
}

}  // namespace mms
