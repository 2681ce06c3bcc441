#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// An object of a training image.
struct ObjectMask {
  int category = 0;          ///< index of its class
  bool crowd = false;        ///< is neither to be found nor to be left out
  int x = 0;                 ///< left column of `mask` in the image [px]
  int y = 0;                 ///< top row of `mask` in the image [px]
  Image<std::uint8_t> mask;  ///< cropped to the object: 1 on it
};

/// A picture and the objects in it. Beyond `width` x `height` (as much of the picture as is real)
/// there is padding.
struct Sample {
  Image<Rgb> image;
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  std::vector<ObjectMask> objects;
};

/// Number of pixels of a mask.
int mask_area(const Image<std::uint8_t>& mask);

/// The object with its mask cropped to what is left of it; nothing is left where the mask is empty.
ObjectMask tightened(const ObjectMask& object);

/// Scales a mask, mirrors it if wanted, moves it by (dx, dy) and cuts it to width x height.
struct MaskPlacement {
  double scale = 1.0;
  bool flip = false;
  int source_width = 0;  ///< of the picture before it was scaled [px]
  int dx = 0;            ///< of the scaled picture's corner [px]
  int dy = 0;
  int width = 0;  ///< of the canvas [px]
  int height = 0;
};
ObjectMask placed(const ObjectMask& object, const MaskPlacement& placement);

}  // namespace mms
