#pragma once

#include <vector>

#include "mms/core/image.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// A picture as the network takes it.
struct PreparedImage {
  std::vector<float> planes;  ///< 3 x height x width, normalised; padding right and below is 0
  int width = 0;              ///< a multiple of 32 [px]
  int height = 0;
  int valid_width = 0;  ///< of the scaled picture, without the padding [px]
  int valid_height = 0;
  int image_width = 0;  ///< of the picture as given [px]
  int image_height = 0;
};

/// Scales a picture so that it fits into the network's sides, subtracts ImageNet's mean colour,
/// divides by its deviation, and pads.
PreparedImage prepare_image(const Image<Rgb>& image, const NetworkConfig& config);

/// Normalises `width` x `height` pixels of a picture into planes of plane_width x plane_height that
/// start at `planes`.
void normalise(const Image<Rgb>& image, int width, int height, int plane_width, int plane_height,
               float* planes);

/// The next multiple of the network's largest stride, 96 at least [px].
int padded_length(int length);

}  // namespace mms
