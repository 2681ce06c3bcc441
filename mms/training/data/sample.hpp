#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// An object of a training image.
struct ObjectMask {
  int category = 0;          ///< index of its class
  bool crowd = false;        ///< ignored in the loss
  int x = 0;                 ///< left column of `mask` in the image [px]
  int y = 0;                 ///< top row of `mask` in the image [px]
  Image<std::uint8_t> mask;  ///< cropped to the object: 1 on the object
  bool box_only = false;     ///< the mask is unknown, `mask` is the box
};

/// An image with its objects. Beyond `width` x `height` it is padded.
struct Sample {
  Image<Rgb> image;
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  std::vector<ObjectMask> objects;
  std::vector<int> partial;  ///< categories whose objects are not all there
};

/// Number of pixels of a mask.
int mask_area(const Image<std::uint8_t>& mask);

/// Ignores an object whose mask is unknown if less than half of its box is left: the object itself
/// may be hidden or outside.
/// @param whole  area of the box before [px]
void doubt_box(ObjectMask& rest, double whole);

/// The object with its mask cropped to its non-zero part; empty if there is none.
ObjectMask tightened(const ObjectMask& object);

/// Scales a mask, optionally mirrors it, moves it by (dx, dy) and crops it to width x height.
struct MaskPlacement {
  double scale = 1.0;
  bool flip = false;
  int source_width = 0;  ///< of the image before scaling [px]
  int dx = 0;            ///< of the scaled image's corner [px]
  int dy = 0;
  int width = 0;  ///< of the canvas [px]
  int height = 0;
};
ObjectMask placed(const ObjectMask& object, const MaskPlacement& placement);

}  // namespace mms
