#pragma once

#include <vector>

#include "mms/core/image.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// Input of the network.
struct PreparedImage {
  std::vector<float> planes;  ///< 3 x height x width, normalized; padding right and below is 0
  int width = 0;              ///< a multiple of 32 [px]
  int height = 0;
  int valid_width = 0;  ///< of the scaled image, without padding [px]
  int valid_height = 0;
  int image_width = 0;  ///< of the original image [px]
  int image_height = 0;
};

/// Scales an image to fit into the network's sides, subtracts ImageNet's mean color, divides by its
/// standard deviation, and pads.
PreparedImage prepare_image(const Image<Rgb>& image, const NetworkConfig& config);

/// Normalizes `width` x `height` pixels of an image into planes of plane_width x plane_height that
/// start at `planes`.
void normalise(const Image<Rgb>& image, int width, int height, int plane_width, int plane_height,
               float* planes);

/// The next multiple of the network's largest stride, at least 96 [px].
int padded_length(int length);

}  // namespace mms
