#include "mms/segmentation/onnx/opencv_network.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/segmentation/onnx/scale_repair.hpp"

namespace mms::onnx {
namespace {

constexpr std::size_t kMaxReason = 160;

/// The fault without OpenCV's source files: "Node [Add@ai.onnx]:(onnx_node!/Add) parse error".
std::string reason_of(const std::exception& fault) {
  const auto* opencv = dynamic_cast<const cv::Exception*>(&fault);
  const std::string text = opencv != nullptr ? opencv->err : fault.what();
  const std::size_t end = std::min(text.find('\n'), text.find(": OpenCV("));
  return text.substr(0, std::min(end, kMaxReason));
}

std::string running(int width, int height) {
  return "run it on " + size_text(width, height) + " px";
}

/// Runs an action that may throw in OpenCV.
template <class Action>
void guarded(const std::string& where, const std::string& doing, const Action& action) {
  try {
    action();
  } catch (const std::exception& fault) {
    throw DataError(where, "OpenCV " CV_VERSION " cannot " + doing + ": " + reason_of(fault),
                    "export it with opset=12 simplify=True, YOLO26 also with end2end=False");
  }
}

}  // namespace

OpencvNetwork::OpencvNetwork(const std::string& bytes, const std::string& where, int width,
                             int height)
    : where_(where) {
  guarded(where_, "read it", [&] {
    network_ = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    network_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    outputs_ = network_.getUnconnectedOutLayersNames();
  });
  guarded(where_, running(width, height), [&] { repair_scales(network_, {1, 3, height, width}); });
}

std::vector<cv::Mat> OpencvNetwork::forward(const cv::Mat& input) {
  std::vector<cv::Mat> results;
  guarded(where_, running(input.size[3], input.size[2]), [&] {
    network_.setInput(input);
    network_.forward(results, outputs_);
  });
  for (cv::Mat& result : results) {
    if (result.type() != CV_32F) throw DataError(where_, "gives outputs that are not float32");
    if (!result.isContinuous()) result = result.clone();
  }
  return results;
}

}  // namespace mms::onnx
