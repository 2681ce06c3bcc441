#include "mms/segmentation/onnx/scale_repair.hpp"

#include <opencv2/dnn/all_layers.hpp>
#include <opencv2/dnn/shape_utils.hpp>

namespace mms::onnx {
namespace {

/// Whether one or more consecutive axes of a tensor from `axis` on have `values` values in total.
bool fits(const cv::dnn::MatShape& shape, int axis, std::size_t values) {
  std::size_t product = 1;
  for (std::size_t i = static_cast<std::size_t>(axis); i < shape.size(); ++i) {
    product *= static_cast<std::size_t>(shape[i]);
    if (product == values) return true;
  }
  return false;
}

/// The axis from which to the last a tensor has `values` values; negative if there is none.
int trailing_axis(const cv::dnn::MatShape& shape, std::size_t values) {
  std::size_t product = 1;
  for (int axis = static_cast<int>(shape.size()) - 1; axis >= 0; --axis) {
    product *= static_cast<std::size_t>(shape[static_cast<std::size_t>(axis)]);
    if (product == values) return axis;
  }
  return -1;
}

void repair(cv::dnn::ScaleLayer& layer, const cv::dnn::MatShape& shape) {
  const std::size_t values = layer.blobs[0].total();
  if (layer.axis < 0 || fits(shape, layer.axis, values)) return;
  const int axis = trailing_axis(shape, values);
  if (axis > 0) layer.axis = axis;
}

}  // namespace

void repair_scales(cv::dnn::Net& network, const cv::dnn::MatShape& input) {
  std::vector<int> ids;
  std::vector<std::vector<cv::dnn::MatShape>> inputs;
  std::vector<std::vector<cv::dnn::MatShape>> outputs;
  network.getLayersShapes(input, ids, inputs, outputs);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto layer = network.getLayer(ids[i]).dynamicCast<cv::dnn::ScaleLayer>();
    if (layer && !layer->blobs.empty() && !inputs[i].empty()) repair(*layer, inputs[i][0]);
  }
}

}  // namespace mms::onnx
