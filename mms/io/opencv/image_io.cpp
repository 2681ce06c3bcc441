#include "mms/io/image/image_io.hpp"

#include <algorithm>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "mms/core/error.hpp"
#include "mms/io/image/image_container.hpp"
#include "mms/io/opencv/png_decoder.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

static_assert(sizeof(Rgb) == 3, "pixels are passed to OpenCV bytewise");

constexpr const char* kDepthWanted = "a 16-bit depth image of 1 channel";

/// Faults are reported by our own errors instead of OpenCV's log. Its decoder of EXR is enabled,
/// which is off by default.
void prepare_opencv() {
  static const bool done = [] {
    setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0);
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    return true;
  }();
  static_cast<void>(done);
}

[[noreturn]] void fail_damaged(const std::string& where) {
  throw DataError(where, "is a damaged image that cannot be decoded");
}

cv::Mat decode(std::string_view bytes, int flags, const std::string& where) {
  prepare_opencv();
  check_whole_image(bytes, where);
  if (bytes.starts_with("\x89PNG")) {
    const cv::Mat pixels = decode_png(bytes, flags != cv::IMREAD_UNCHANGED);
    if (pixels.empty()) fail_damaged(where);
    return pixels;
  }
  cv::Mat decoded;
  try {  // the matrix refers to the bytes, which the decoder only reads
    const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8U,
                          const_cast<char*>(bytes.data()));
    decoded = cv::imdecode(encoded, flags);
  } catch (const cv::Exception&) {
    decoded.release();
  }
  if (decoded.empty()) fail_damaged(where);
  return decoded;
}

Image<Rgb> decode_rgb(std::string_view bytes, const std::string& where) {
  const cv::Mat bgr = decode(bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION, where);
  Image<Rgb> image(bgr.cols, bgr.rows);
  cv::Mat rgb(image.height(), image.width(), CV_8UC3, image.pixels().data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return image;
}

/// Matrix on an image's own pixels; OpenCV has no const matrix, so callers must only read.
template <class T>
cv::Mat view(const Image<T>& image, int type) {
  return {image.height(), image.width(), type, const_cast<T*>(image.pixels().data())};
}

[[noreturn]] void fail_pixels(const cv::Mat& decoded, const std::string& expected,
                              const std::string& where) {
  throw DataError(where, "has pixels of " + std::to_string(8 * decoded.elemSize1()) + " bits and " +
                             std::to_string(decoded.channels()) + " channel(s), expected " +
                             expected);
}

/// Copies a matrix with one channel of T.
template <class T>
Image<T> image_of(const cv::Mat& decoded) {
  Image<T> image(decoded.cols, decoded.rows);
  for (int y = 0; y < decoded.rows; ++y) {
    std::copy_n(decoded.ptr<T>(y), image.width(), image.row(y));
  }
  return image;
}

/// Decodes an image with one channel of `type`.
template <class T>
Image<T> decode_plain(std::string_view bytes, int type, const std::string& expected,
                      const std::string& where) {
  const cv::Mat decoded = decode(bytes, cv::IMREAD_UNCHANGED, where);
  if (decoded.type() != type) fail_pixels(decoded, expected, where);
  return image_of<T>(decoded);
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<std::uint8_t> encode(const char* extension, const cv::Mat& pixels,
                                 const std::vector<int>& options = {}) {
  prepare_opencv();
  if (pixels.empty()) throw DataError("image", "is empty and cannot be encoded");
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, pixels, bytes, options);
  return bytes;
}

cv::Mat to_bgr(const Image<Rgb>& image) {
  cv::Mat bgr;
  if (!image.empty()) cv::cvtColor(view(image, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

}  // namespace

Image<Rgb> read_color(const fs::path& path) {
  return decode_rgb(read_file(path), path.string());
}

Image<Rgb> decode_color(std::span<const std::uint8_t> bytes, const std::string& where) {
  return decode_rgb(text_of(bytes), where);
}

StoredDepth read_stored_depth(const fs::path& path) {
  cv::Mat decoded = decode(read_file(path), cv::IMREAD_UNCHANGED, path.string());
  if (decoded.type() == CV_16UC1) return image_of<std::uint16_t>(decoded);
  if (decoded.depth() != CV_32F) {
    fail_pixels(decoded, std::string(kDepthWanted) + ", or 32-bit numbers", path.string());
  }
  if (decoded.channels() > 1) cv::extractChannel(decoded, decoded, 0);
  return image_of<float>(decoded);
}

Image<std::uint16_t> read_depth16(const fs::path& path) {
  return decode_plain<std::uint16_t>(read_file(path), CV_16UC1, kDepthWanted, path.string());
}

Image<std::uint16_t> decode_depth16(std::span<const std::uint8_t> bytes, const std::string& where) {
  return decode_plain<std::uint16_t>(text_of(bytes), CV_16UC1, kDepthWanted, where);
}

Image<std::uint8_t> read_mask(const fs::path& path) {
  return decode_plain<std::uint8_t>(read_file(path), CV_8UC1, "an 8-bit label PNG of 1 channel",
                                    path.string());
}

void write_png(const fs::path& path, const Image<Rgb>& image) {
  write_file(path, encode_png(image));
}

void write_png(const fs::path& path, const Image<std::uint8_t>& image) {
  write_file(path, encode_png(image));
}

void write_png(const fs::path& path, const Image<std::uint16_t>& image) {
  write_file(path, encode_png(image));
}

std::vector<std::uint8_t> encode_png(const Image<Rgb>& image) {
  return encode(".png", to_bgr(image));
}

std::vector<std::uint8_t> encode_png(const Image<std::uint8_t>& image) {
  return encode(".png", view(image, CV_8UC1));
}

std::vector<std::uint8_t> encode_png(const Image<std::uint16_t>& image) {
  return encode(".png", view(image, CV_16UC1));
}

std::vector<std::uint8_t> encode_jpeg(const Image<Rgb>& image, int quality) {
  return encode(".jpg", to_bgr(image), {cv::IMWRITE_JPEG_QUALITY, quality});
}

}  // namespace mms
