#include "mms/segmentation/segmentation_config.hpp"

namespace mms {

void SegmentationConfig::visit(ConfigVisitor& v) {
  v.text({"weights", "", "the network's file; none: the one that the program comes with"}, weights);
  v.integer({"threads", "", "of the network; 0: one a core"}, threads, {0, 256});
  v.group({"objects", "", "which objects count as dynamic"}, objects);
  v.group({"decoder", "", "which masks of our networks are kept"}, decoder);
  v.group({"onnx", "", "networks of others: ONNX models with the outputs of YOLO-seg"}, onnx);
}

}  // namespace mms
