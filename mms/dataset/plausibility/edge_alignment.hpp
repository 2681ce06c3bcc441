#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mms/dataset/plausibility/image_edges.hpp"

namespace mms {

/// Compares the edges of depth images or masks with their color images over some frames: the edges
/// are where the color image has large gradients. So it finds depth images or masks that are
/// mirrored, turned, or not registered to the color images.
class EdgeAlignment {
 public:
  void add(ImageEdges frame);

  /// What is wrong, in one phrase such as "mirrored left to right"; nullopt if nothing is, or if
  /// the frames have too few edges.
  /// @param delay_gain  gain in rank by other color images (`EdgeDelay`), which explains a shift if
  /// that gains little more
  std::optional<std::string> fault(double delay_gain) const;

 private:
  /// Mean rank of the color gradient at the warped edges.
  double score(const EdgeWarp& warp) const;
  std::optional<std::string> unregistered(double score_as_is, double delay_gain) const;

  std::vector<ImageEdges> frames_;
  std::size_t edges_ = 0;
};

}  // namespace mms
