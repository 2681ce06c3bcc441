#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// Compares the edges of depth images with those of their color images over some frames: a
/// registered depth image has its edges where the color image has large gradients. So it finds
/// depth that is mirrored, turned, or not registered to the color images.
class DepthAlignment {
 public:
  /// Adds a frame; does nothing if the sizes of the images differ.
  /// @param depth  [m]; 0, NaN and infinity: no return
  void add(const Image<Rgb>& color, const Image<float>& depth);

  /// What is wrong, in one phrase such as "mirrored left to right"; nullopt if nothing is, or if
  /// the frames have too few edges.
  std::optional<std::string> fault() const;

 private:
  /// A pixel beside a jump of the depth, at half the resolution.
  struct Edge {
    float x;
    float y;
  };

  /// A frame at half the resolution.
  struct Frame {
    Image<float> gradient;  ///< rank of the color gradient, in [0, 1]; maximum of 3x3 pixels
    std::vector<Edge> edges;
  };

  /// Similarity of images, and a shift.
  struct Warp;

  /// Mean rank of the color gradient at the warped edges.
  double score(const Warp& warp) const;
  std::optional<std::string> unregistered(double score_as_is) const;

  std::vector<Frame> frames_;
  std::size_t edges_ = 0;
};

}  // namespace mms
