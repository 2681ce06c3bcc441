#include "mms/io/image/image_container.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/core/image.hpp"
#include "mms/core/size_text.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

using Bytes = std::string_view;

/// What a file's header says.
struct Size {
  std::uint64_t width = 0;        ///< [px]
  std::uint64_t height = 0;       ///< [px]
  std::uint64_t pixel_bytes = 4;  ///< of a decoded pixel, at most [B]
};

/// A whole number of `count` bytes; the caller checks that they are there.
std::uint64_t big_endian(Bytes bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = at; i < at + count; ++i) {
    value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  }
  return value;
}

std::uint64_t little_endian(Bytes bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = count; i-- > 0;) {
    value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  }
  return value;
}

constexpr Bytes kPngSignature = "\x89PNG\r\n\x1a\n";

/// Iterates over the chunks (length, type, data, CRC) up to the end chunk.
bool png_is_whole(Bytes bytes) {
  constexpr std::size_t kChunkFrame = 12;
  std::size_t at = kPngSignature.size();
  while (at + kChunkFrame <= bytes.size()) {
    const std::uint64_t length = big_endian(bytes, at, 4);
    if (length > bytes.size() - at - kChunkFrame) return false;
    if (bytes.substr(at + 4, 4) == "IEND") return true;
    at += kChunkFrame + length;
  }
  return false;
}

std::optional<Size> png_size(Bytes bytes) {
  constexpr std::size_t kWidthAt = 16;
  if (bytes.size() < kWidthAt + 9) return std::nullopt;
  const std::uint64_t pixel_bytes = bytes[kWidthAt + 8] == 16 ? 8 : 4;  // up to four channels
  return Size{big_endian(bytes, kWidthAt, 4), big_endian(bytes, kWidthAt + 4, 4), pixel_bytes};
}

/// Scan data contain neither FF D9 nor FF DA, so the file is complete if the end marker is last.
bool jpeg_is_whole(Bytes bytes) {
  const std::size_t end = bytes.rfind("\xFF\xD9");
  const std::size_t scan = bytes.rfind("\xFF\xDA");
  return end != Bytes::npos && scan != Bytes::npos && end > scan;
}

/// Iterates over the segments (marker, length, data) up to the frame header, C0 to CF without C4,
/// C8 and CC, which are tables.
std::optional<Size> jpeg_size(Bytes bytes) {
  std::size_t at = 2;
  while (at + 9 <= bytes.size()) {
    const auto marker = static_cast<std::uint8_t>(bytes[at + 1]);
    if (bytes[at] != '\xFF' || marker == 0xFF) {  // libjpeg skips bytes between segments
      ++at;
      continue;
    }
    if (marker <= 0x01 || (marker >= 0xD0 && marker <= 0xD8)) {  // without a length
      at += 2;
      continue;
    }
    if (marker == 0xD9 || marker == 0xDA) return std::nullopt;
    const bool table = marker == 0xC4 || marker == 0xC8 || marker == 0xCC;
    if (marker >= 0xC0 && marker <= 0xCF && !table) {
      return Size{big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
    }
    at += 2 + big_endian(bytes, at + 2, 2);
  }
  return std::nullopt;
}

bool bmp_is_whole(Bytes bytes) {
  constexpr std::size_t kHeader = 26;
  return bytes.size() >= kHeader && little_endian(bytes, 2, 4) <= bytes.size();
}

/// A negative height means rows from top to bottom.
std::optional<Size> bmp_size(Bytes bytes) {
  constexpr std::uint64_t kSign = 0x80000000U;
  constexpr std::uint64_t kRange = 0x100000000U;
  if (bytes.size() < 26) return std::nullopt;
  const std::uint64_t height = little_endian(bytes, 22, 4);
  return Size{little_endian(bytes, 18, 4), height >= kSign ? kRange - height : height};
}

bool webp_is_whole(Bytes bytes) {
  return little_endian(bytes, 4, 4) + 8 <= bytes.size();
}

/// Size of the canvas (VP8X), or of the only image, lossless (VP8L) or not (VP8).
std::optional<Size> webp_size(Bytes bytes) {
  if (bytes.size() < 30) return std::nullopt;
  const Bytes kind = bytes.substr(12, 4);
  if (kind == "VP8X") {
    return Size{1 + little_endian(bytes, 24, 3), 1 + little_endian(bytes, 27, 3)};
  }
  constexpr std::uint64_t kSideMask = 0x3FFF;
  const std::uint64_t sides = little_endian(bytes, 21, 4);
  if (kind == "VP8L") return Size{1 + (sides & kSideMask), 1 + (sides >> 14 & kSideMask)};
  return Size{little_endian(bytes, 26, 2) & kSideMask, little_endian(bytes, 28, 2) & kSideMask};
}

/// Width (tag 256) and height (257) in the first directory, or of its tiles (322, 323) if they are
/// larger. A pixel has `SamplesPerPixel` (277) numbers of `BitsPerSample` (258).
std::optional<Size> tiff_size(Bytes bytes) {
  constexpr std::size_t kEntry = 12;
  const bool little = bytes[0] == 'I';
  const auto number = [&](std::size_t at, std::size_t count) {
    return little ? little_endian(bytes, at, count) : big_endian(bytes, at, count);
  };
  if (bytes.size() < 8) return std::nullopt;
  const std::size_t directory = number(4, 4);
  if (directory + 2 > bytes.size()) return std::nullopt;
  const std::size_t entries = number(directory, 2);
  Size size{0, 0, 1};
  std::uint64_t samples = 1;
  std::uint64_t bits = 8;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t at = directory + 2 + i * kEntry;
    if (at + kEntry > bytes.size()) return std::nullopt;
    const std::uint64_t tag = number(at, 2);
    const std::uint64_t value = number(at + 8, number(at + 2, 2) == 3 ? 2 : 4);
    if (tag == 256 || tag == 322) size.width = std::max(size.width, value);
    if (tag == 257 || tag == 323) size.height = std::max(size.height, value);
    if (tag == 277) samples = std::min<std::uint64_t>(value, UINT16_MAX);
    if (tag != 258) continue;
    constexpr std::uint64_t kInPlace = 2;  // more numbers are elsewhere
    const std::uint64_t place = number(at + 4, 4) > kInPlace ? number(at + 8, 4) : at + 8;
    if (place + 2 > bytes.size()) return std::nullopt;
    bits = std::max(bits, number(place, 2));
  }
  size.pixel_bytes = std::max<std::uint64_t>(samples * ((bits + 7) / 8), 1);
  return size;
}

/// Width and height in the header "Pf\nWIDTH HEIGHT\nSCALE\n", and where the data begin.
std::optional<std::pair<Size, std::size_t>> pfm_header(Bytes bytes) {
  constexpr std::size_t kSizeAt = 3;
  const std::size_t size_end = bytes.find('\n', kSizeAt);
  const std::size_t scale_end =
      size_end == Bytes::npos ? Bytes::npos : bytes.find('\n', size_end + 1);
  if (scale_end == Bytes::npos) return std::nullopt;
  const Bytes size = bytes.substr(kSizeAt, size_end - kSizeAt);
  const std::size_t space = size.find(' ');
  if (space == Bytes::npos) return std::nullopt;
  const auto width = parse_integer(size.substr(0, space));
  const auto height = parse_integer(size.substr(space + 1));
  if (!width || !height || *width <= 0 || *height <= 0) return std::nullopt;
  const std::uint64_t pixel_bytes = bytes.starts_with("PF") ? 3 * sizeof(float) : sizeof(float);
  return {
      {Size{static_cast<std::uint64_t>(*width), static_cast<std::uint64_t>(*height), pixel_bytes},
       scale_end + 1}};
}

std::optional<Size> pfm_size(Bytes bytes) {
  const auto header = pfm_header(bytes);
  return header ? std::optional(header->first) : std::nullopt;
}

bool pfm_is_whole(Bytes bytes) {
  const auto header = pfm_header(bytes);
  if (!header) return false;
  const auto& [width, height, pixel] = header->first;
  if (width > kMaxImageSide || height > kMaxImageSide) return true;  // refused for its size
  return bytes.size() - header->second >= width * height * pixel;
}

/// The whole numbers at the start of a header of PGM, between blanks and comments; `at` moves to
/// the byte after the last one. nullopt if there are fewer.
std::optional<std::array<std::uint64_t, 3>> pgm_numbers(Bytes bytes, std::size_t& at) {
  constexpr Bytes kBlanks = " \t\r\n";
  constexpr Bytes kDigits = "0123456789";
  std::array<std::uint64_t, 3> numbers{};
  for (std::uint64_t& number : numbers) {
    at = bytes.find_first_not_of(kBlanks, at);
    while (at < bytes.size() && bytes[at] == '#') {
      at = bytes.find_first_not_of(kBlanks, bytes.find('\n', at));
    }
    if (at >= bytes.size()) return std::nullopt;
    const std::size_t end = std::min(bytes.find_first_not_of(kDigits, at), bytes.size());
    const auto value = parse_integer(bytes.substr(at, end - at));
    if (!value || *value <= 0) return std::nullopt;
    number = static_cast<std::uint64_t>(*value);
    at = end;
  }
  return numbers;
}

/// Width, height and largest value in the header "P5 WIDTH HEIGHT MAX ", and where the data begin.
std::optional<std::pair<Size, std::size_t>> pgm_header(Bytes bytes) {
  std::size_t at = 2;
  const auto numbers = pgm_numbers(bytes, at);
  if (!numbers) return std::nullopt;
  const auto& [width, height, largest] = *numbers;
  return {{Size{width, height, largest > UINT8_MAX ? 2U : 1U}, at + 1}};
}

std::optional<Size> pgm_size(Bytes bytes) {
  const auto header = pgm_header(bytes);
  return header ? std::optional(header->first) : std::nullopt;
}

bool pgm_is_whole(Bytes bytes) {
  const auto header = pgm_header(bytes);
  if (!header || header->second > bytes.size()) return false;
  const auto& [width, height, pixel] = header->first;
  if (width > kMaxImageSide || height > kMaxImageSide) return true;  // refused for its size
  return bytes.size() - header->second >= width * height * pixel;
}

/// An attribute in the header of an EXR file: name, type, size and value.
struct ExrAttribute {
  Bytes name;
  Bytes value;
  std::size_t end;  ///< where the next one begins
};

/// nullopt where it goes on behind the end of the file.
std::optional<ExrAttribute> exr_attribute(Bytes bytes, std::size_t at) {
  const std::size_t name_end = bytes.find('\0', at);
  const std::size_t type_end = name_end == Bytes::npos ? name_end : bytes.find('\0', name_end + 1);
  if (type_end == Bytes::npos || type_end + 5 > bytes.size()) return std::nullopt;
  const std::size_t value = type_end + 5;
  const std::uint64_t length = little_endian(bytes, type_end + 1, 4);
  if (length > bytes.size() - value) return std::nullopt;
  return ExrAttribute{bytes.substr(at, name_end - at), bytes.substr(value, length), value + length};
}

constexpr std::size_t kExrAttributes = 8;  // after signature and version

/// Of the attribute dataWindow, which has xMin, yMin, xMax, yMax as int32.
/// Of equal attributes, OpenEXR takes the last one, so that the largest one counts.
std::optional<Size> exr_size(Bytes bytes) {
  std::optional<Size> largest;
  std::size_t at = kExrAttributes;
  while (at < bytes.size() && bytes[at] != '\0') {
    const auto attribute = exr_attribute(bytes, at);
    if (!attribute) return largest;
    if (attribute->name == "dataWindow" && attribute->value.size() == 16) {
      const auto side = [&](std::size_t low) {
        const auto number = [&](std::size_t k) {
          return static_cast<std::int64_t>(
              static_cast<std::int32_t>(little_endian(attribute->value, k, 4)));
        };
        return static_cast<std::uint64_t>(
            std::max<std::int64_t>(0, number(low + 8) - number(low) + 1));
      };
      if (!largest) largest = Size{0, 0, 4 * sizeof(float)};
      largest->width = std::max(largest->width, side(0));
      largest->height = std::max(largest->height, side(4));
    }
    at = attribute->end;
  }
  return largest;
}

/// Whether the headers, several in files of several parts, have what they say: OpenEXR allocates
/// before it reads.
bool exr_is_whole(Bytes bytes) {
  std::size_t at = kExrAttributes;
  while (at < bytes.size()) {
    if (bytes[at] == '\0') {
      const bool parts = (bytes[5] & 0x10) != 0;
      ++at;
      if (!parts || at >= bytes.size() || bytes[at] == '\0') return true;
    }
    const auto attribute = exr_attribute(bytes, at);
    if (!attribute) return false;
    at = attribute->end;
  }
  return at <= bytes.size();
}

bool is_whole(Bytes) {
  return true;
}

struct Container {
  const char* name;
  Bytes signature;
  bool (*is_whole)(Bytes);
  std::optional<Size> (*size)(Bytes);
};

constexpr Container kContainers[] = {{"PNG", kPngSignature, png_is_whole, png_size},
                                     {"JPEG", "\xFF\xD8\xFF", jpeg_is_whole, jpeg_size},
                                     {"TIFF", Bytes("II*\0", 4), is_whole, tiff_size},
                                     {"TIFF", Bytes("MM\0*", 4), is_whole, tiff_size},
                                     {"BMP", "BM", bmp_is_whole, bmp_size},
                                     {"EXR", "\x76\x2F\x31\x01", exr_is_whole, exr_size},
                                     {"PFM", "Pf\n", pfm_is_whole, pfm_size},
                                     {"PFM", "PF\n", pfm_is_whole, pfm_size},
                                     {"PGM", "P5", pgm_is_whole, pgm_size},
                                     {"WebP", "RIFF", webp_is_whole, webp_size}};

const Container* container_of(Bytes bytes) {
  constexpr std::size_t kWebpAt = 8;
  const auto* found =
      std::find_if(std::begin(kContainers), std::end(kContainers), [&](const Container& container) {
        const bool riff = container.signature == "RIFF";
        return bytes.starts_with(container.signature) &&
               (!riff || (bytes.size() >= kWebpAt + 4 && bytes.substr(kWebpAt, 4) == "WEBP"));
      });
  return found == std::end(kContainers) ? nullptr : found;
}

void check_size(const Size& size, const std::string& where) {
  constexpr std::uint64_t kLimit = kMaxImageSide;
  const std::string pixels = "is " + size_text(size.width, size.height) + " pixels";
  if (size.width > kLimit || size.height > kLimit) {
    throw DataError(where, pixels + ", allowed: up to 16384x16384", "the header may be damaged");
  }
  constexpr std::uint64_t kPixelBytes = 8;  // of the largest image allowed
  const std::uint64_t count = size.width * size.height;
  const std::uint64_t most = pixel_limit();
  if (count <= most && count <= kPixelBytes * most / size.pixel_bytes) return;
  throw DataError(where,
                  pixels + " of up to " + std::to_string(size.pixel_bytes) +
                      " bytes, allowed: up to " + std::to_string(most) + " pixels and " +
                      std::to_string((kPixelBytes * most) >> 20U) + " MiB",
                  "the environment variable MMS_MAX_IMAGE_PIXELS sets the limit");
}

}  // namespace

std::uint64_t pixel_limit() {
  static const std::uint64_t limit = [] {
    constexpr std::uint64_t kDefault = std::uint64_t{1} << 26U;
    const char* given = std::getenv("MMS_MAX_IMAGE_PIXELS");
    if (given == nullptr) return kDefault;
    const auto number = parse_integer(given);
    if (number && *number > 0) return static_cast<std::uint64_t>(*number);
    throw ConfigError("MMS_MAX_IMAGE_PIXELS",
                      "is '" + std::string(given) + "', allowed: 1 or more");
  }();
  return limit;
}

void check_whole_image(std::string_view bytes, const std::string& where) {
  if (bytes.empty()) throw DataError(where, "is empty, expected an image");
  const Container* container = container_of(bytes);
  if (container == nullptr) {
    throw DataError(where, "is no image that can be read",
                    "known: PNG, JPEG, BMP, WebP, TIFF, EXR, PFM, PGM");
  }
  if (!container->is_whole(bytes)) {
    throw DataError(where, std::string("is a truncated ") + container->name + " of " +
                               std::to_string(bytes.size()) + " bytes");
  }
  const std::optional<Size> size = container->size(bytes);
  if (!size) {  // a decoder may find one, and would allocate what it says
    throw DataError(where, std::string("is a damaged ") + container->name + ": it has no size");
  }
  check_size(*size, where);
}

}  // namespace mms
