#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/segmentation/detection/detector.hpp"
#include "mms/segmentation/onnx/onnx_config.hpp"

namespace mms {

namespace onnx {
class OpencvNetwork;
}

/// Somebody else's network: an ONNX model for instance segmentation with the outputs of YOLOv5-seg,
/// YOLOv8-seg or YOLO11-seg, run on the CPU by OpenCV's DNN module.
class OnnxDetector : public Detector {
 public:
  /// Reads the model and runs it once on an empty picture, so that faults show here.
  /// @param threads  of OpenCV, for the whole program; 0: one a core
  /// @throws FileError when the file cannot be read; DataError when it is no ONNX model, OpenCV
  ///         cannot run it, or its outputs are of no known layout for its classes.
  OnnxDetector(const std::filesystem::path& model, const OnnxConfig& config, int threads);
  ~OnnxDetector() override;

  std::vector<Detection> detect(const Image<Rgb>& image) override;
  const std::vector<std::string>& classes() const override { return classes_; }

 private:
  std::string where_;
  OnnxConfig config_;
  int width_ = 0;  ///< of the input [px]
  int height_ = 0;
  std::vector<std::string> classes_;
  std::unique_ptr<onnx::OpencvNetwork> network_;
};

}  // namespace mms
