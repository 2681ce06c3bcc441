#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mms {

/// Largest width or height of an image [px]; a 12 MP camera has 4096.
inline constexpr int kMaxImageSide = 16384;

/// 8-bit color in the order red, green, blue.
struct Rgb {
  std::uint8_t r = 0;  ///< red
  std::uint8_t g = 0;  ///< green
  std::uint8_t b = 0;  ///< blue

  bool operator==(const Rgb&) const = default;
};

/// Dense row-major image of `width` columns and `height` rows that owns its pixels. Pixel (x, y): x
/// to the right, y down; its center has the coordinates (x, y).
template <class T>
class Image {
 public:
  Image() = default;  ///< 0 x 0
  /// All pixels have the same value. Sides in [px], not negative.
  Image(int width, int height, T value = T())
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}

  int width() const { return width_; }                 ///< [px]
  int height() const { return height_; }               ///< [px]
  std::size_t size() const { return pixels_.size(); }  ///< number of pixels
  bool empty() const { return pixels_.empty(); }       ///< whether it has no pixels

  /// @{
  /// Pixels by row, by (x, y), by row-major index, or all. Indices are checked in debug builds
  /// only.
  T* row(int y) { return pixels_.data() + index(0, y); }
  const T* row(int y) const { return pixels_.data() + index(0, y); }
  T& operator()(int x, int y) { return pixels_[index(x, y)]; }
  const T& operator()(int x, int y) const { return pixels_[index(x, y)]; }
  T& operator[](std::size_t i) { return pixels_[i]; }
  const T& operator[](std::size_t i) const { return pixels_[i]; }

  std::vector<T>& pixels() { return pixels_; }
  const std::vector<T>& pixels() const { return pixels_; }
  /// @}

  /// Whether (x, y) is a pixel.
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  /// Whether width and height are equal.
  template <class U>
  bool same_size(const Image<U>& other) const {
    return width_ == other.width() && height_ == other.height();
  }

 private:
  std::size_t index(int x, int y) const {
    assert(x >= 0 && x < (width_ > 0 ? width_ : 1) && y >= 0 && y < height_);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> pixels_;
};

}  // namespace mms
