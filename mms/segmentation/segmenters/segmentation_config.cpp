#include "mms/segmentation/segmenters/segmentation_config.hpp"

#include <array>
#include <string_view>

namespace mms {

void SegmentationConfig::visit(ConfigVisitor& v) {
  v.text({"weights", "", "weights file, everyday or nano; none: everyday"}, weights);
  constexpr std::array<std::string_view, 3> kBackends = {"auto", "engine", "libtorch"};
  v.enumeration(
      {"backend", "",
       "backend of our networks; auto: libtorch with a GPU or if required, else the engine"},
      backend, kBackends);
  constexpr std::array<std::string_view, 3> kPrecisions = {"auto", "float32", "int8"};
  v.enumeration({"precision", "", "of the engine; auto: int8 for quantized weights"}, precision,
                kPrecisions);
  v.integer({"long_side", "px",
             "long side of our networks' input: larger for distant objects, smaller for speed; 0: "
             "as trained"},
            long_side, {0, 4096});
  v.integer({"threads", "", "of the network; 0: one per core"}, threads, {0, 256});
  v.group({"objects", "", "which objects count as dynamic"}, objects);
  v.group({"decoder", "", "which masks of our networks are kept"}, decoder);
  v.group({"onnx", "", "other networks: ONNX models with the outputs of YOLO-seg"}, onnx);
}

}  // namespace mms
