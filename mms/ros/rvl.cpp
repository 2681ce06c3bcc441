#include "mms/ros/rvl.hpp"

#include <string_view>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/io/journal/byte_reader.hpp"

namespace mms {
namespace {

/// Most pixels of an image, since zeros take no space in the data: a 12 MP camera has fewer.
constexpr std::size_t kMaxPixels = 16'000'000;

/// Numbers of four-bit groups, whose highest bit says that another one follows. Eight of them are
/// in each 32-bit word, from its high to its low end.
class Nibbles {
 public:
  explicit Nibbles(ByteReader bytes) : bytes_(std::move(bytes)) {}

  std::uint32_t number() {
    constexpr unsigned kBits = 3;  // of the number in a group
    constexpr unsigned kWord = 32;
    std::uint32_t value = 0;
    for (unsigned shift = 0; shift < kWord; shift += kBits) {
      const std::uint32_t group = next();
      value |= (group & 0x7U) << shift;
      if ((group & 0x8U) == 0) return value;
    }
    throw DataError(bytes_.where(), "is damaged RVL data");
  }

 private:
  std::uint32_t next() {
    if (left_ == 0) {
      word_ = bytes_.take<std::uint32_t>();
      left_ = 8;
    }
    --left_;
    return (word_ >> (4U * left_)) & 0xFU;
  }

  ByteReader bytes_;
  std::uint32_t word_ = 0;
  unsigned left_ = 0;  ///< groups
};

}  // namespace

Image<std::uint16_t> decode_rvl(std::span<const std::uint8_t> bytes, const std::string& where) {
  ByteReader reader({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, where);
  const auto width = reader.take<std::uint32_t>();
  const auto height = reader.take<std::uint32_t>();
  if (width == 0 || height == 0 || width > kMaxPixels / height) {
    throw DataError(where, "is " + size_text(width, height) + " pixels, allowed: 1 to " +
                               std::to_string(kMaxPixels));
  }
  Image<std::uint16_t> image(static_cast<int>(width), static_cast<int>(height));
  Nibbles nibbles(std::move(reader));
  std::uint32_t value = 0;  // the previous depth, modulo 2^32 as in the reference
  for (std::size_t i = 0; i < image.size();) {
    const std::size_t zeros = nibbles.number();
    const std::size_t depths = nibbles.number();
    if (zeros + depths > image.size() - i || zeros + depths == 0) {
      throw DataError(where, "is damaged RVL data");
    }
    i += zeros;
    for (const std::size_t end = i + depths; i < end; ++i) {
      const std::uint32_t zigzag = nibbles.number();  // 0, -1, 1, -2, ...
      value += (zigzag >> 1U) ^ (0U - (zigzag & 1U));
      image[i] = static_cast<std::uint16_t>(value);
    }
  }
  return image;
}

}  // namespace mms
