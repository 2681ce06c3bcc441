#include "mms/segmentation/onnx/onnx_detector.hpp"

#include <fstream>
#include <opencv2/imgproc.hpp>

#include "mms/core/error.hpp"
#include "mms/core/utf8.hpp"
#include "mms/segmentation/detection/coco_classes.hpp"
#include "mms/segmentation/onnx/class_names.hpp"
#include "mms/segmentation/onnx/letterbox.hpp"
#include "mms/segmentation/onnx/model_header.hpp"
#include "mms/segmentation/onnx/opencv_network.hpp"
#include "mms/segmentation/onnx/quiet_log.hpp"
#include "mms/segmentation/onnx/yolo_decoder.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

const cv::Scalar kPadding(114, 114, 114);  // gray, as in YOLO tools

std::string bytes_of(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw FileError(path.string(), "no such file");
  if (!fs::is_regular_file(path, error)) throw FileError(path.string(), "is not a regular file");
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(stream ? fs::file_size(path, error) : 0, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream || error) throw FileError(path.string(), "cannot be read");
  return bytes;
}

/// @throws DataError if a name cannot be written to JSON.
void check_names(const std::vector<std::string>& names, const std::string& where) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (is_utf8(names[i])) continue;
    throw DataError(where, "the name of class " + std::to_string(i) + " is not UTF-8",
                    "name the classes by the setting segmentation.onnx.classes");
  }
}

/// Classes of the settings, else of the model, else of COCO.
std::vector<std::string> classes_of(const OnnxConfig& config, const onnx::ModelHeader& header,
                                    const std::string& where) {
  std::vector<std::string> given = onnx::listed_names(config.classes, "classes");
  check_names(given, "classes");
  if (!given.empty()) return given;
  check_names(header.classes, where);
  return header.classes.empty() ? coco_classes() : header.classes;
}

/// The image centered on a gray input: 1 x 3 x height x width, red first, in [0, 1].
cv::Mat input_of(const Image<Rgb>& image, const onnx::Letterbox& letterbox) {
  const auto& [x, y] = letterbox;
  const cv::Mat pixels(image.height(), image.width(), CV_8UC3, const_cast<Rgb*>(image.row(0)));
  cv::Mat scaled;
  cv::resize(pixels, scaled, cv::Size(x.scaled, y.scaled), 0, 0, cv::INTER_LINEAR);
  cv::Mat padded;
  cv::copyMakeBorder(scaled, padded, y.offset, y.input - y.scaled - y.offset, x.offset,
                     x.input - x.scaled - x.offset, cv::BORDER_CONSTANT, kPadding);
  return cv::dnn::blobFromImage(padded, 1.0 / 255.0);
}

std::vector<onnx::Shape> shapes_of(const std::vector<cv::Mat>& outputs) {
  std::vector<onnx::Shape> shapes;
  shapes.reserve(outputs.size());
  for (const cv::Mat& output : outputs) {
    shapes.emplace_back(output.size.p, output.size.p + output.dims);
  }
  return shapes;
}

}  // namespace

OnnxDetector::OnnxDetector(const fs::path& model, const OnnxConfig& config, int threads)
    : where_(model.string()), config_(config) {
  const std::string bytes = bytes_of(model);
  const onnx::ModelHeader header = onnx::read_model_header(bytes, where_);
  width_ = header.width > 0 ? header.width : config.input_side;
  height_ = header.height > 0 ? header.height : config.input_side;
  classes_ = classes_of(config, header, where_);
  const onnx::QuietLog quiet;
  cv::setNumThreads(threads > 0 ? threads : -1);
  network_ = std::make_unique<onnx::OpencvNetwork>(bytes, where_, width_, height_);
  detect(Image<Rgb>(width_, height_));
}

OnnxDetector::~OnnxDetector() = default;

std::vector<Detection> OnnxDetector::detect(const Image<Rgb>& image) {
  if (image.empty()) return {};
  const onnx::Letterbox letterbox =
      onnx::fit_letterbox(image.width(), image.height(), width_, height_);
  const std::vector<cv::Mat> outputs = network_->forward(input_of(image, letterbox));
  const onnx::YoloLayout layout =
      onnx::find_layout(shapes_of(outputs), static_cast<int>(classes_.size()), where_);
  return onnx::decode_yolo(
      {outputs[layout.predictions].ptr<float>(), outputs[layout.prototypes].ptr<float>()}, layout,
      letterbox, config_);
}

}  // namespace mms
