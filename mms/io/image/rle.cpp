#include "mms/io/image/rle.hpp"

#include <algorithm>
#include <numeric>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/io/image/image_container.hpp"

namespace mms {
namespace {

// Compressed form: five bits per character, the sixth marks a continuation.
constexpr int kBits = 5;
constexpr std::int64_t kValueBits = 0x1f;
constexpr std::int64_t kSignBit = 0x10;
constexpr std::int64_t kMoreBit = 0x20;
constexpr char kFirstLetter = '0';
constexpr char kLastLetter = 'o';
constexpr int kMaxShift = 35;  // of a 32-bit count with sign

std::uint64_t pixels_of(const Rle& rle) {
  return static_cast<std::uint64_t>(rle.width) * static_cast<std::uint64_t>(rle.height);
}

template <class Inside>
Rle encode(const Image<std::uint8_t>& image, const Inside& inside) {
  Rle rle{image.width(), image.height(), {}};
  bool current = false;
  std::uint32_t run = 0;
  for (int x = 0; x < image.width(); ++x) {
    for (int y = 0; y < image.height(); ++y) {
      if (inside(image(x, y)) != current) {
        rle.counts.push_back(run);
        run = 0;
        current = !current;
      }
      ++run;
    }
  }
  rle.counts.push_back(run);
  return rle;
}

/// Calls `body(first, last)` with the pixel range (column-major) of every run of the mask.
template <class Body>
void for_each_run(const Rle& rle, const Body& body) {
  std::uint64_t position = 0;
  for (std::size_t i = 0; i < rle.counts.size(); ++i) {
    const std::uint64_t end = position + rle.counts[i];
    if (i % 2 == 1 && end > position) body(position, end - 1);
    position = end;
  }
}

void append_letters(std::string& text, std::int64_t value) {
  bool more = true;
  while (more) {
    std::int64_t letter = value & kValueBits;
    value >>= kBits;
    more = (letter & kSignBit) != 0 ? value != -1 : value != 0;
    if (more) letter |= kMoreBit;
    text += static_cast<char>(letter + kFirstLetter);
  }
}

/// Removes one number from the front of `text`.
std::int64_t take_number(std::string_view& text) {
  std::int64_t value = 0;
  for (int shift = 0;; shift += kBits) {
    if (text.empty()) throw DataError("compressed mask", "ends within a number");
    const char c = text.front();
    if (c < kFirstLetter || c > kLastLetter) {
      throw DataError("compressed mask",
                      "has the character '" + std::string(1, c) + "', allowed: '0' to 'o'");
    }
    if (shift > kMaxShift) throw DataError("compressed mask", "has a number of more than 32 bits");
    text.remove_prefix(1);
    const std::int64_t letter = c - kFirstLetter;
    value |= (letter & kValueBits) << shift;
    if ((letter & kMoreBit) != 0) continue;
    if ((letter & kSignBit) != 0) value |= -(std::int64_t{1} << (shift + kBits));
    return value;
  }
}

}  // namespace

Rle encode_rle(const Image<std::uint8_t>& mask) {
  return encode(mask, [](std::uint8_t pixel) { return pixel != 0; });
}

Rle encode_rle(const Image<std::uint8_t>& labels, std::uint8_t value) {
  return encode(labels, [value](std::uint8_t pixel) { return pixel == value; });
}

void check_rle(const Rle& rle) {
  if (rle.width > 0 && rle.height > 0 && pixels_of(rle) > pixel_limit()) {
    throw DataError("mask",
                    "has " + std::to_string(rle.width) + " x " + std::to_string(rle.height) +
                        " pixels, allowed: up to " + std::to_string(pixel_limit()) + " pixels",
                    "the environment variable MMS_MAX_IMAGE_PIXELS sets the limit");
  }
  const std::uint64_t sum = std::accumulate(rle.counts.begin(), rle.counts.end(), std::uint64_t{0});
  if (rle.width >= 0 && rle.height >= 0 && sum == pixels_of(rle)) return;
  throw DataError("mask", "its runs have " + std::to_string(sum) + " pixels, the image has " +
                              std::to_string(rle.width) + " x " + std::to_string(rle.height));
}

Rle encode_rle(const Image<std::uint8_t>& cut, int x, int y, int width, int height) {
  if (x < 0 || y < 0 || x + cut.width() > width || y + cut.height() > height) {
    throw DataError("mask", size_text(cut.width(), cut.height()) + " px at (" + std::to_string(x) +
                                ", " + std::to_string(y) + ") exceeds its image of " +
                                size_text(width, height));
  }
  Rle rle{width, height, {}};
  std::uint64_t end = 0;  // of the last run of the mask
  const auto add_run = [&](std::uint64_t first, std::uint64_t length) {
    if (first == end && !rle.counts.empty()) {
      rle.counts.back() += static_cast<std::uint32_t>(length);
    } else {
      rle.counts.push_back(static_cast<std::uint32_t>(first - end));
      rle.counts.push_back(static_cast<std::uint32_t>(length));
    }
    end = first + length;
  };
  for (int u = 0; u < cut.width(); ++u) {
    for (int v = 0; v < cut.height();) {
      const int first = v;
      while (v < cut.height() && cut(u, v) != 0) ++v;
      const std::uint64_t column =
          static_cast<std::uint64_t>(x + u) * static_cast<unsigned>(height);
      if (v > first)
        add_run(column + static_cast<unsigned>(y + first), static_cast<unsigned>(v - first));
      if (v == first) ++v;
    }
  }
  if (pixels_of(rle) > end) rle.counts.push_back(static_cast<std::uint32_t>(pixels_of(rle) - end));
  return rle;
}

Image<std::uint8_t> decode_rle(const Rle& rle) {
  check_rle(rle);
  Image<std::uint8_t> mask(rle.width, rle.height);
  const auto height = static_cast<std::uint64_t>(rle.height);
  for_each_run(rle, [&](std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t i = first; i <= last; ++i) {
      mask(static_cast<int>(i / height), static_cast<int>(i % height)) = 1;
    }
  });
  return mask;
}

std::uint64_t rle_area(const Rle& rle) {
  std::uint64_t area = 0;
  for (std::size_t i = 1; i < rle.counts.size(); i += 2) area += rle.counts[i];
  return area;
}

std::array<double, 4> rle_box(const Rle& rle) {
  const auto height = static_cast<std::uint64_t>(rle.height);
  std::uint64_t left = pixels_of(rle);
  std::uint64_t right = 0;
  std::uint64_t top = height;
  std::uint64_t bottom = 0;
  for_each_run(rle, [&](std::uint64_t first, std::uint64_t last) {
    const bool one_column = first / height == last / height;
    left = std::min(left, first / height);
    right = std::max(right, last / height + 1);
    top = std::min(top, one_column ? first % height : 0);
    bottom = std::max(bottom, one_column ? last % height + 1 : height);
  });
  if (right == 0) return {};
  return {static_cast<double>(left), static_cast<double>(top), static_cast<double>(right - left),
          static_cast<double>(bottom - top)};
}

std::string rle_to_string(const Rle& rle) {
  std::string text;
  for (std::size_t i = 0; i < rle.counts.size(); ++i) {
    const std::int64_t before = i > 2 ? rle.counts[i - 2] : 0;
    append_letters(text, static_cast<std::int64_t>(rle.counts[i]) - before);
  }
  return text;
}

Rle rle_from_string(std::string_view text, int width, int height) {
  Rle rle{width, height, {}};
  while (!text.empty()) {
    const std::size_t i = rle.counts.size();
    const std::int64_t count = take_number(text) + (i > 2 ? rle.counts[i - 2] : 0);
    if (count < 0 || count > static_cast<std::int64_t>(pixels_of(rle))) {
      throw DataError("compressed mask", "has a run of " + std::to_string(count) +
                                             " pixels in an image of " + std::to_string(width) +
                                             " x " + std::to_string(height));
    }
    rle.counts.push_back(static_cast<std::uint32_t>(count));
  }
  check_rle(rle);
  return rle;
}

}  // namespace mms
