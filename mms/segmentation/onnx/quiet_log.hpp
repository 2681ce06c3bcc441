#pragma once

#include <opencv2/core/utils/logger.hpp>

namespace mms::onnx {

/// While it lives, OpenCV does not print what it throws as well. For the whole program: not to be
/// used while other threads are in OpenCV.
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
