#pragma once

#include "mms/core/image.hpp"

namespace mms {

/// Scales an image with bilinear weights that widen for downsampling (anti-aliased, as in PIL).
/// Pixel areas are aligned, not pixel centers.
/// @param width, height of the result [px], at least 1
Image<Rgb> resize(const Image<Rgb>& image, int width, int height);

/// A rectangle of pixels.
struct Window {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The part of `resize(image, width, height)` in a window, without computing the rest.
Image<Rgb> resize_part(const Image<Rgb>& image, int width, int height, const Window& window);

/// The factor with which width x height fits into long_side x short_side [px], in either
/// orientation.
double fitting_scale(int width, int height, int long_side, int short_side);

/// A scaled length, rounded, at least 1 [px].
int scaled_length(int length, double scale);

}  // namespace mms
