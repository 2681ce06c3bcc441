#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/left_out_frames.hpp"

namespace mms {

/// Finds frames whose color or depth image, or scan, is that of the frame before, value by value.
/// Drivers and recorders without a new image give the last one again; the noise of a sensor never
/// does. The pose would stand still with them, and jump afterwards. A color image that does not
/// change any more, though the depth does, is removed.
class RepeatedFrames {
 public:
  /// Receives one line with frame and fault.
  using WarningHandler = std::function<void(const std::string&)>;

  /// Whether a frame is to be left out. The next one that is not gets its motion samples and place.
  /// @param warn  called for the first one, and where the color image does not change any more
  bool omits(Frame& frame, const WarningHandler& warn = {});

  std::size_t count() const { return count_; }  ///< frames to be left out so far

  /// Whether the color image of the last frame was removed.
  bool has_old_color() const { return has_old_color_; }

 private:
  bool repeats(const Frame& frame);
  bool keeps(Frame& frame);
  void keep(const Frame& frame);

  // Of the last frame that was not left out:
  Image<Rgb> color_;
  Timestamp color_since_;
  Image<float> depth_;
  std::vector<Eigen::Vector3f> points_;
  LeftOutFrames left_out_;
  std::size_t count_ = 0;
  bool has_old_color_ = false;
};

}  // namespace mms
