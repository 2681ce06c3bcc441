#include "mms/dataset/camera/v4l2_pixels.hpp"

#include "mms/io/image/yuv_color.hpp"

namespace mms {
namespace {

constexpr std::size_t kPixelBytes = 2;  // of YUYV and Z16

constexpr int kGray = 128;

const std::uint8_t* row_of(std::span<const std::uint8_t> bytes, const RawImageLayout& layout,
                           int y) {
  return bytes.data() + static_cast<std::size_t>(y) * layout.pitch;
}

}  // namespace

bool holds_image(std::span<const std::uint8_t> bytes, const RawImageLayout& layout) {
  if (layout.width <= 0 || layout.height <= 0) return false;
  const std::size_t row = kPixelBytes * static_cast<std::size_t>(layout.width);
  const auto rows = static_cast<std::size_t>(layout.height);
  return layout.pitch >= row && bytes.size() >= (rows - 1) * layout.pitch + row;
}

Image<Rgb> color_from_yuyv(std::span<const std::uint8_t> bytes, const RawImageLayout& layout) {
  Image<Rgb> color(layout.width, layout.height);
  for (int y = 0; y < layout.height; ++y) {
    const std::uint8_t* pair = row_of(bytes, layout, y);
    Rgb* pixel = color.row(y);
    for (int x = 0; x + 1 < layout.width; x += 2, pair += 2 * kPixelBytes) {
      const int cb = pair[1] - kGray;
      const int cr = pair[3] - kGray;
      pixel[x] = rgb_of_yuv(pair[0], cb, cr);
      pixel[x + 1] = rgb_of_yuv(pair[2], cb, cr);
    }
  }
  return color;
}

Image<float> depth_from_z16(std::span<const std::uint8_t> bytes, const RawImageLayout& layout,
                            double scale) {
  const auto units = static_cast<float>(scale);
  Image<float> depth(layout.width, layout.height);
  for (int y = 0; y < layout.height; ++y) {
    const std::uint8_t* raw = row_of(bytes, layout, y);
    float* pixel = depth.row(y);
    for (int x = 0; x < layout.width; ++x, raw += kPixelBytes) {
      pixel[x] = static_cast<float>(raw[0] | raw[1] << 8) / units;
    }
  }
  return depth;
}

}  // namespace mms
