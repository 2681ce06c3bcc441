#pragma once

#include <opencv2/core/utils/logger.hpp>

namespace mms::onnx {

/// Suppresses OpenCV's messages during its lifetime; faults are reported as exceptions. For the
/// whole program: not to be used while other threads use OpenCV.
class QuietLog {
 public:
  QuietLog() : before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietLog() { cv::utils::logging::setLogLevel(before_); }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;

 private:
  cv::utils::logging::LogLevel before_;
};

}  // namespace mms::onnx
