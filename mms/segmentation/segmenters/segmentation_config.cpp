#include "mms/segmentation/segmenters/segmentation_config.hpp"

#include <array>
#include <string_view>

namespace mms {

void SegmentationConfig::visit(ConfigVisitor& v) {
  v.text({"weights", "", "the network's file; none: the one that the program comes with"}, weights);
  constexpr std::array<std::string_view, 3> kBackends = {"auto", "engine", "libtorch"};
  v.enumeration({"backend", "",
                 "what computes our networks; auto: libtorch where it finds a GPU or has to, else "
                 "the engine"},
                backend, kBackends);
  constexpr std::array<std::string_view, 3> kPrecisions = {"auto", "float32", "int8"};
  v.enumeration({"precision", "", "of the engine; auto: int8 where the weights were quantized"},
                precision, kPrecisions);
  v.integer({"long_side", "px",
             "longer side of our networks' input: larger sees farther, smaller is faster; 0: as "
             "trained"},
            long_side, {0, 4096});
  v.integer({"threads", "", "of the network; 0: one a core"}, threads, {0, 256});
  v.group({"objects", "", "which objects count as dynamic"}, objects);
  v.group({"decoder", "", "which masks of our networks are kept"}, decoder);
  v.group({"onnx", "", "networks of others: ONNX models with the outputs of YOLO-seg"}, onnx);
}

}  // namespace mms
