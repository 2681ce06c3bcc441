#pragma once

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"

namespace mms {

/// Image of an organized cloud with colors: dynamic points tinted red, those
/// of overruled masks blue, pixels without depth dimmed.
Image<Rgb> draw_overlay(const LabeledCloud& cloud);

}  // namespace mms
