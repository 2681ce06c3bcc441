#pragma once

#include "mms/core/image.hpp"

namespace mms {

/// Scales a picture with bilinear weights that widen when it shrinks, so that nothing is skipped
/// (anti-aliased, as PIL's). Pixel areas are aligned, not pixel centres.
/// @param width, height  wanted [px], at least 1
Image<Rgb> resize(const Image<Rgb>& image, int width, int height);

/// The factor with which width x height just fits into long_side x short_side [px], whichever way
/// it lies.
double fitting_scale(int width, int height, int long_side, int short_side);

/// A scaled length, rounded, at least 1 [px].
int scaled_length(int length, double scale);

}  // namespace mms
