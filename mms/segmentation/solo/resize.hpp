#pragma once

#include "mms/core/image.hpp"

namespace mms {

/// Scales an image with bilinear weights that widen for downsampling (anti-aliased, as in PIL).
/// Pixel areas are aligned, not pixel centers.
/// @param width, height of the result [px], at least 1
Image<Rgb> resize(const Image<Rgb>& image, int width, int height);

/// The factor with which width x height fits into long_side x short_side [px], in either
/// orientation.
double fitting_scale(int width, int height, int long_side, int short_side);

/// A scaled length, rounded, at least 1 [px].
int scaled_length(int length, double scale);

}  // namespace mms
