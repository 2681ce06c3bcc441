#pragma once

#include "mms/training/data/sample.hpp"

namespace mms::testing {

/// A box as an object.
inline ObjectMask box_object(int category, int x, int y, int width, int height) {
  return {category, false, x, y, Image<std::uint8_t>(width, height, 1)};
}

/// An image with the position in every pixel: r = x, g = y.
inline Sample sample_of(int width, int height, std::vector<ObjectMask> objects = {}) {
  Sample sample;
  sample.image = Image<Rgb>(width, height);
  sample.width = width;
  sample.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      sample.image(x, y) = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), 77};
    }
  }
  sample.objects = std::move(objects);
  return sample;
}

}  // namespace mms::testing
