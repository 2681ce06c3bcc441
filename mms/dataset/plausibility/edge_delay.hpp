#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>

#include "mms/core/time.hpp"
#include "mms/dataset/plausibility/image_edges.hpp"

namespace mms {

/// Compares the edges of depth images or masks with the color images of the frames before and after
/// them. Where something moves, they fit those of their own time best. So it finds depth images or
/// masks that show the scene of an earlier or later frame.
class EdgeDelay {
 public:
  /// Longest delay that is found [frames].
  static constexpr int kMaxFrames = 5;

  /// Adds the next frame of a recording.
  /// @param begins  it does not follow the frame that was added before
  void add(Timestamp stamp, ImageEdges frame, bool begins);

  /// Frames by which the edges are ahead of the color images, negative if behind.
  int frames() const;

  /// What is wrong, in one phrase such as "2 frames (67 ms) behind the color images"; nullopt if
  /// nothing is, or if too little moves.
  std::optional<std::string> fault() const;

  /// Mean gain in rank if the edges are compared with color images `frames` later.
  double gain(int frames) const;

 private:
  struct Entry {
    Timestamp stamp;
    ImageEdges image;
    double own;  ///< mean rank at its edges in its own color image
  };

  void compare(const Entry& edges, const Entry& color, int frames);

  std::deque<Entry> recent_;
  std::size_t edges_ = 0;
  std::size_t added_ = 0;                              ///< frames
  std::array<EdgeScore, 2 * kMaxFrames + 1> gains_{};  ///< by frames + kMaxFrames
  double interval_sum_ = 0.0;                          ///< [s]
  std::size_t intervals_ = 0;
};

}  // namespace mms
