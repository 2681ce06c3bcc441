#include "mms/ros/image_messages.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/ros/raw_colors.hpp"
#include "mms/ros/rvl.hpp"

namespace mms {
namespace {

/// Positions of the samples in a pixel of a color encoding.
struct ColorLayout {
  const char* encoding;
  std::size_t size;  ///< of a pixel [bytes]
  std::size_t r, g, b;
};

constexpr ColorLayout kColorLayouts[] = {
    {"rgb8", 3, 0, 1, 2},  {"bgr8", 3, 2, 1, 0}, {"8UC3", 3, 2, 1, 0},  {"rgba8", 4, 0, 1, 2},
    {"bgra8", 4, 2, 1, 0}, {"8UC4", 4, 2, 1, 0}, {"mono8", 1, 0, 0, 0}, {"8UC1", 1, 0, 0, 0},
};

const ColorLayout* color_layout(const std::string& encoding) {
  const auto* found =
      std::find_if(std::begin(kColorLayouts), std::end(kColorLayouts),
                   [&](const ColorLayout& layout) { return encoding == layout.encoding; });
  return found == std::end(kColorLayouts) ? nullptr : found;
}

/// @throws DataError if rows are incomplete.
void check_layout(const msg::Image& message, std::size_t pixel_size, const std::string& where) {
  const std::string size = size_text(message.width, message.height) + " pixels";
  if (message.width == 0 || message.height == 0 || message.width > kMaxImageSide ||
      message.height > kMaxImageSide) {
    throw DataError(where, "is " + size + ", allowed: 1x1 to 16384x16384");
  }
  const std::size_t row = message.width * pixel_size;
  const std::size_t expected = message.height * std::size_t{message.step};
  if (message.step >= row && message.data.size() >= expected) return;
  throw DataError(where, "has " + std::to_string(message.data.size()) + " bytes in rows of " +
                             std::to_string(message.step) + ", but " + size + " of " +
                             message.encoding + " need " + std::to_string(row * message.height));
}

/// Reads the numbers of an image with one channel, in either byte order.
template <class T>
Image<T> plain_image(const msg::Image& message, const std::string& where) {
  check_layout(message, sizeof(T), where);
  Image<T> image(static_cast<int>(message.width), static_cast<int>(message.height));
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* row = message.data.data() + std::size_t{message.step} * unsigned(y);
    std::memcpy(image.row(y), row, sizeof(T) * message.width);
  }
  if (message.is_bigendian == 0 || sizeof(T) == 1) return image;
  for (T& pixel : image.pixels()) {
    auto* bytes = reinterpret_cast<std::uint8_t*>(&pixel);
    std::reverse(bytes, bytes + sizeof(T));
  }
  return image;
}

[[noreturn]] void fail_encoding(const std::string& encoding, const std::string& expected,
                                const std::string& where) {
  throw DataError(where, "has the encoding '" + encoding + "', expected " + expected);
}

Image<float> metres_of(const Image<std::uint16_t>& raw, double scale) {
  const float units = static_cast<float>(scale);
  Image<float> depth(raw.width(), raw.height());
  for (std::size_t i = 0; i < raw.size(); ++i) depth[i] = static_cast<float>(raw[i]) / units;
  return depth;
}

bool starts_as_png(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t kStart[] = {0x89, 'P', 'N', 'G'};
  return bytes.size() > 4 && std::equal(std::begin(kStart), std::end(kStart), bytes.begin());
}

/// Header of compressed_depth_image_transport before its PNG: quantization of 32-bit depth.
struct DepthHeader {
  std::int32_t format;
  float a;
  float b;
};

/// Depth in meters of 16-bit inverse depths: raw = a / depth + b.
Image<float> dequantised(const Image<std::uint16_t>& raw, const DepthHeader& header) {
  Image<float> depth(raw.width(), raw.height());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const float inverse = static_cast<float>(raw[i]) - header.b;
    depth[i] = raw[i] == 0 || inverse <= 0.0F ? 0.0F : header.a / inverse;
  }
  return depth;
}

/// The message without data, with rows without padding.
msg::Image message_for(const msg::Header& header, int width, int height, const char* encoding,
                       std::size_t pixel_size) {
  msg::Image message;
  message.header = header;
  message.width = static_cast<std::uint32_t>(width);
  message.height = static_cast<std::uint32_t>(height);
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(pixel_size * message.width);
  message.data.resize(std::size_t{message.step} * message.height);
  return message;
}

template <class T>
msg::Image plain_message(const msg::Header& header, const Image<T>& image, const char* encoding) {
  msg::Image message = message_for(header, image.width(), image.height(), encoding, sizeof(T));
  if (!image.empty()) std::memcpy(message.data.data(), image.row(0), message.data.size());
  return message;
}

}  // namespace

bool is_depth_encoding(const std::string& encoding) {
  return encoding == "16UC1" || encoding == "mono16" || encoding == "32FC1";
}

bool is_color_encoding(const std::string& encoding) {
  return color_layout(encoding) != nullptr || raw_color_size(encoding) > 0;
}

Image<Rgb> color_of(const msg::Image& message, const std::string& where) {
  if (message.encoding == "mono16") {
    const Image<std::uint16_t> raw = plain_image<std::uint16_t>(message, where);
    Image<Rgb> image(raw.width(), raw.height());
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const auto grey = static_cast<std::uint8_t>(raw[i] >> 8);
      image[i] = {grey, grey, grey};
    }
    return image;
  }
  if (const std::size_t size = raw_color_size(message.encoding); size > 0) {
    check_layout(message, size, where);
    return raw_color_of(message, where);
  }
  const ColorLayout* layout = color_layout(message.encoding);
  if (layout == nullptr) {
    fail_encoding(message.encoding,
                  "rgb8, bgr8, rgba8, bgra8, mono8, mono16, 8UC1, 8UC3, 8UC4, yuv422, yuv422_yuy2 "
                  "or Bayer patterns of 8 bits (bayer_rggb8)",
                  where);
  }
  check_layout(message, layout->size, where);
  Image<Rgb> image(static_cast<int>(message.width), static_cast<int>(message.height));
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* pixel = message.data.data() + std::size_t{message.step} * unsigned(y);
    Rgb* row = image.row(y);
    for (int x = 0; x < image.width(); ++x, pixel += layout->size) {
      row[x] = {pixel[layout->r], pixel[layout->g], pixel[layout->b]};
    }
  }
  return image;
}

Image<Rgb> color_of(const msg::CompressedImage& message, const std::string& where) {
  return decode_color(message.data, where);
}

Image<float> depth_of(const msg::Image& message, const std::string& where, double scale) {
  if (message.encoding == "32FC1") return plain_image<float>(message, where);
  if (!is_depth_encoding(message.encoding)) {
    fail_encoding(message.encoding, "16UC1, mono16 or 32FC1 of a depth image", where);
  }
  return metres_of(plain_image<std::uint16_t>(message, where), scale);
}

Image<float> depth_of(const msg::CompressedImage& message, const std::string& where, double scale) {
  if (starts_as_png(message.data)) return metres_of(decode_depth16(message.data, where), scale);
  const std::span bytes(message.data);
  if (bytes.size() < sizeof(DepthHeader)) throw DataError(where, "ends too early");
  DepthHeader header{};
  std::memcpy(&header, bytes.data(), sizeof header);
  const std::span image = bytes.subspan(sizeof header);
  const bool rvl = message.format.find("rvl") != std::string::npos;
  if (!rvl && !starts_as_png(image)) {
    throw DataError(where, "has the format '" + message.format + "' and contains no PNG",
                    "compressed depth is supported as PNG and RVL");
  }
  const Image<std::uint16_t> raw = rvl ? decode_rvl(image, where) : decode_depth16(image, where);
  return message.format.starts_with("32FC1") ? dequantised(raw, header) : metres_of(raw, scale);
}

bool is_mask_encoding(const std::string& encoding) {
  return encoding == "mono8" || encoding == "8UC1";
}

Image<std::uint8_t> mask_of(const msg::Image& message, const std::string& where) {
  if (!is_mask_encoding(message.encoding)) {
    fail_encoding(message.encoding, "mono8 or 8UC1 of a label image", where);
  }
  return plain_image<std::uint8_t>(message, where);
}

msg::Image image_message(const msg::Header& header, const Image<Rgb>& image) {
  return plain_message(header, image, "rgb8");
}
msg::Image image_message(const msg::Header& header, const Image<float>& depth) {
  return plain_message(header, depth, "32FC1");
}
msg::Image image_message(const msg::Header& header, const Image<std::uint16_t>& depth) {
  return plain_message(header, depth, "16UC1");
}
msg::Image image_message(const msg::Header& header, const Image<std::uint8_t>& mask) {
  return plain_message(header, mask, "mono8");
}

msg::CompressedImage compressed_message(const msg::Header& header, const Image<Rgb>& image,
                                        int quality) {
  return {header, "rgb8; jpeg compressed bgr8", encode_jpeg(image, quality)};
}

msg::CompressedImage compressed_message(const msg::Header& header,
                                        const Image<std::uint16_t>& depth) {
  msg::CompressedImage message{header, "16UC1; compressedDepth png", {}};
  message.data.resize(sizeof(DepthHeader));
  const std::vector<std::uint8_t> png = encode_png(depth);
  message.data.insert(message.data.end(), png.begin(), png.end());
  return message;
}

}  // namespace mms
