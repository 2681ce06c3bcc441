#include "mms/ros/raw_colors.hpp"

#include <array>
#include <cstdint>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/io/image/yuv_color.hpp"

namespace mms {
namespace {

/// Positions of the bytes of two pixels that share their chroma.
struct YuvPair {
  std::size_t y0, cb, y1, cr;
};

constexpr YuvPair kUyvy{1, 0, 3, 2};
constexpr YuvPair kYuyv{0, 1, 2, 3};

const YuvPair* yuv_pair(const std::string& encoding) {
  if (encoding == "yuv422" || encoding == "uyvy") return &kUyvy;
  if (encoding == "yuv422_yuy2" || encoding == "yuyv") return &kYuyv;
  return nullptr;
}

/// Channels (0 red, 1 green, 2 blue) of the pixels (0, 0), (1, 0), (0, 1), (1, 1); they repeat.
using BayerPattern = std::array<std::size_t, 4>;

struct NamedPattern {
  const char* encoding;
  BayerPattern pattern;
};

constexpr NamedPattern kPatterns[] = {{"bayer_rggb8", {0, 1, 1, 2}},
                                      {"bayer_bggr8", {2, 1, 1, 0}},
                                      {"bayer_gbrg8", {1, 2, 0, 1}},
                                      {"bayer_grbg8", {1, 0, 2, 1}}};

const BayerPattern* bayer_pattern(const std::string& encoding) {
  for (const NamedPattern& named : kPatterns) {
    if (encoding == named.encoding) return &named.pattern;
  }
  return nullptr;
}

const std::uint8_t* row_of(const msg::Image& message, int y) {
  return message.data.data() + std::size_t{message.step} * static_cast<std::size_t>(y);
}

Image<Rgb> color_of_yuv(const msg::Image& message, const YuvPair& at) {
  constexpr int kGray = 128;
  constexpr std::size_t kPairBytes = 4;
  Image<Rgb> color(static_cast<int>(message.width), static_cast<int>(message.height));
  for (int y = 0; y < color.height(); ++y) {
    const std::uint8_t* pair = row_of(message, y);
    Rgb* pixel = color.row(y);
    for (int x = 0; x < color.width(); x += 2, pair += kPairBytes) {
      const int cb = pair[at.cb] - kGray;
      const int cr = pair[at.cr] - kGray;
      pixel[x] = rgb_of_yuv(pair[at.y0], cb, cr);
      pixel[x + 1] = rgb_of_yuv(pair[at.y1], cb, cr);
    }
  }
  return color;
}

/// Mirrored at the border, which keeps the pattern.
int inside(int i, int side) {
  return i < 0 ? -i : i >= side ? 2 * side - 2 - i : i;
}

Rgb bayer_pixel(const msg::Image& message, const BayerPattern& pattern, int x, int y) {
  const int width = static_cast<int>(message.width);
  const int height = static_cast<int>(message.height);
  const auto channel_of = [&](int u, int v) {
    return pattern[static_cast<std::size_t>(2 * (v & 1) + (u & 1))];
  };
  std::array<int, 3> sums{};
  std::array<int, 3> counts{};
  for (int dy = -1; dy <= 1; ++dy) {
    const int v = inside(y + dy, height);
    const std::uint8_t* row = row_of(message, v);
    for (int dx = -1; dx <= 1; ++dx) {
      const int u = inside(x + dx, width);
      const std::size_t channel = channel_of(u, v);
      sums[channel] += row[u];
      ++counts[channel];
    }
  }
  const std::size_t own = channel_of(x, y);
  sums[own] = row_of(message, y)[x];
  counts[own] = 1;
  const auto mean = [&](std::size_t channel) {
    return static_cast<std::uint8_t>((sums[channel] + counts[channel] / 2) / counts[channel]);
  };
  return {mean(0), mean(1), mean(2)};
}

Image<Rgb> color_of_bayer(const msg::Image& message, const BayerPattern& pattern) {
  Image<Rgb> color(static_cast<int>(message.width), static_cast<int>(message.height));
  for (int y = 0; y < color.height(); ++y) {
    for (int x = 0; x < color.width(); ++x) color(x, y) = bayer_pixel(message, pattern, x, y);
  }
  return color;
}

[[noreturn]] void fail_sides(const msg::Image& message, const char* allowed,
                             const std::string& where) {
  throw DataError(where, "is " + size_text(message.width, message.height) + " pixels of " +
                             message.encoding + ", allowed: " + allowed);
}

}  // namespace

std::size_t raw_color_size(const std::string& encoding) {
  if (yuv_pair(encoding) != nullptr) return 2;
  return bayer_pattern(encoding) != nullptr ? 1 : 0;
}

Image<Rgb> raw_color_of(const msg::Image& message, const std::string& where) {
  if (const YuvPair* pair = yuv_pair(message.encoding)) {
    if (message.width % 2 != 0) fail_sides(message, "an even width", where);
    return color_of_yuv(message, *pair);
  }
  if (message.width < 2 || message.height < 2) fail_sides(message, "2x2 and more", where);
  return color_of_bayer(message, *bayer_pattern(message.encoding));
}

}  // namespace mms
