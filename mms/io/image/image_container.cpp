#include "mms/io/image/image_container.hpp"

#include <cstdint>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr std::string_view kJpegSignature = "\xFF\xD8\xFF";

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i)
    value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

/// Iterates over the chunks (length, type, data, CRC) up to the end chunk.
bool png_is_whole(std::string_view bytes) {
  constexpr std::size_t kChunkFrame = 12;
  std::size_t at = kPngSignature.size();
  while (at + kChunkFrame <= bytes.size()) {
    const std::size_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - kChunkFrame) return false;
    if (bytes.substr(at + 4, 4) == "IEND") return true;
    at += kChunkFrame + length;
  }
  return false;
}

/// Prevents huge allocations after a damaged header.
void check_png_size(std::string_view bytes, const std::string& where) {
  constexpr std::size_t kWidthAt = 16;
  const std::uint32_t width = big_endian(bytes, kWidthAt);
  const std::uint32_t height = big_endian(bytes, kWidthAt + 4);
  if (width <= kMaxImageSide && height <= kMaxImageSide) return;
  throw DataError(where,
                  "is " + std::to_string(width) + "x" + std::to_string(height) +
                      " pixels, allowed: up to 16384x16384",
                  "the header may be damaged");
}

/// Scan data contain neither FF D9 nor FF DA, so the file is complete if the end marker is last.
bool jpeg_is_whole(std::string_view bytes) {
  const std::size_t end = bytes.rfind("\xFF\xD9");
  const std::size_t scan = bytes.rfind("\xFF\xDA");
  return end != std::string_view::npos && scan != std::string_view::npos && end > scan;
}

}  // namespace

void check_whole_image(std::string_view bytes, const std::string& where) {
  const bool png = bytes.starts_with(kPngSignature);
  if (!png && !bytes.starts_with(kJpegSignature)) {
    throw DataError(where, bytes.empty() ? "is empty, expected a PNG or JPEG image"
                                         : "is neither a PNG nor a JPEG image");
  }
  if (!(png ? png_is_whole(bytes) : jpeg_is_whole(bytes))) {
    throw DataError(where, std::string("is a truncated ") + (png ? "PNG" : "JPEG") + " of " +
                               std::to_string(bytes.size()) + " bytes");
  }
  if (png) check_png_size(bytes, where);
}

}  // namespace mms
