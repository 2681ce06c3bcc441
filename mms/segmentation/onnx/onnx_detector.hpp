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

/// An ONNX model for instance segmentation with the outputs of YOLOv5-seg, YOLOv8-seg or
/// YOLO11-seg, run on the CPU by OpenCV's DNN module.
class OnnxDetector : public Detector {
 public:
  /// Reads the model and runs it once on an empty image, to detect faults early.
  /// @param threads  of OpenCV, for the whole program; 0: one per core
  /// @throws FileError if the file cannot be read; DataError if it is not an ONNX model, OpenCV
  /// cannot run it, or its outputs have an unknown layout.
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
