#include "mms/run/segmenter/segmenter_choice.hpp"

#include "mms/core/error.hpp"
#include "mms/run/segmenter/network_detector.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

std::unique_ptr<Segmenter> make_segmenter(const std::string& segmenter, const std::string& data,
                                          const SystemConfig& config, const FrameSource& source) {
  if (segmenter == "none") return std::make_unique<NoneSegmenter>();
  if (segmenter == "network") return make_network_segmenter(config.segmentation);
  if (!source.has_masks()) {
    throw DataError(data, "has no masks",
                    "add label images in its folder masks/, use --masks DIR, or choose --segmenter "
                    "network or none");
  }
  return std::make_unique<MaskSegmenter>();
}

}  // namespace mms
