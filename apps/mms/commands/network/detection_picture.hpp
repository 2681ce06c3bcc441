#pragma once

#include <string>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms {

/// The image with each object tinted and outlined (people red, vehicles green, others blue),
/// labeled with class and score.
Image<Rgb> draw_detections(const Image<Rgb>& image, const std::vector<Detection>& detections,
                           const std::vector<std::string>& classes);

/// Label image: 0 background, else 1 + class id of the dynamic objects.
Image<std::uint8_t> label_image(int width, int height, const std::vector<Detection>& detections,
                                const std::vector<std::string>& classes);

}  // namespace mms
