#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// A pixel at an edge, at half the resolution [px].
struct EdgePixel {
  float x;
  float y;
};

/// The edges of a depth image or mask, and the gradients of its color image, at half the
/// resolution.
struct ImageEdges {
  Image<float> gradient;  ///< rank of the color gradient, in [0, 1]; maximum of 3x3 pixels
  std::vector<EdgePixel> edges;
};

/// Similarity of images, and a shift.
struct EdgeWarp {
  float scale_x = 1.0F;  ///< about the center; negative: mirrored
  float scale_y = 1.0F;
  float shift_x = 0.0F;  ///< [px] at half the resolution
  float shift_y = 0.0F;
};

/// Sum of the ranks of the gradient at edges.
struct EdgeScore {
  double sum = 0.0;
  std::size_t count = 0;

  EdgeScore& operator+=(const EdgeScore& other) {
    sum += other.sum;
    count += other.count;
    return *this;
  }
  double mean() const { return count == 0 ? 0.0 : sum / static_cast<double>(count); }
};

/// @param depth  of the size of `color` [m]; 0, NaN and infinity: no return
ImageEdges depth_edges(const Image<Rgb>& color, const Image<float>& depth);

/// Boundaries of the labels of a mask.
/// @param mask  of the size of `color`
ImageEdges mask_edges(const Image<Rgb>& color, const Image<std::uint8_t>& mask);

/// Ranks of the gradient at the warped edges that are within it.
EdgeScore score_edges(const std::vector<EdgePixel>& edges, const Image<float>& gradient,
                      const EdgeWarp& warp = {});

}  // namespace mms
