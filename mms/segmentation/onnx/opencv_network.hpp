#pragma once

#include <opencv2/dnn/dnn.hpp>
#include <string>
#include <vector>

namespace mms::onnx {

/// An ONNX model in OpenCV's DNN module, on the CPU. OpenCV's faults become DataErrors.
class OpencvNetwork {
 public:
  /// @param bytes          of the file
  /// @param where          name of the file in messages
  /// @param width, height of the images [px]
  /// @throws DataError if OpenCV cannot read the model or it does not accept such images.
  OpencvNetwork(const std::string& bytes, const std::string& where, int width, int height);

  /// The model's outputs, each contiguous float32; valid until the next call.
  /// @param input  1 x 3 x height x width, float32
  /// @throws DataError if OpenCV cannot run the model.
  std::vector<cv::Mat> forward(const cv::Mat& input);

 private:
  std::string where_;
  cv::dnn::Net network_;
  std::vector<std::string> outputs_;
};

}  // namespace mms::onnx
