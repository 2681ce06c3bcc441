#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mms {

/// [px]: the largest width or height of an image; a camera of 12 MP has 4096.
inline constexpr int kMaxImageSide = 16384;

/// One 8-bit colour sample, in the order red, green, blue.
struct Rgb {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;

  bool operator==(const Rgb&) const = default;
};

/// Dense row-major image, `width` columns by `height` rows, that owns its pixels.
/// Pixel (x, y) has x to the right and y down; its centre has the coordinates (x, y).
template <class T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, T value = T())
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return pixels_.size(); }
  bool empty() const { return pixels_.empty(); }

  T* row(int y) { return pixels_.data() + index(0, y); }
  const T* row(int y) const { return pixels_.data() + index(0, y); }
  T& operator()(int x, int y) { return pixels_[index(x, y)]; }
  const T& operator()(int x, int y) const { return pixels_[index(x, y)]; }
  T& operator[](std::size_t i) { return pixels_[i]; }
  const T& operator[](std::size_t i) const { return pixels_[i]; }

  std::vector<T>& pixels() { return pixels_; }
  const std::vector<T>& pixels() const { return pixels_; }

  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
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
