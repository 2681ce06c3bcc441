#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/dataset/plausibility/depth_alignment.hpp"

namespace mms {

/// Checks over some frames of a recording whether depth, calibration and images are plausible.
class RecordingCheck {
 public:
  /// Frames to add, at least a few frames apart.
  static constexpr std::size_t kFrames = 8;

  void add(const Frame& frame);
  std::size_t frames() const { return frames_; }

  /// What is implausible, each in one sentence with figures and a remedy. Frames without depth
  /// images are only checked for their calibration.
  std::vector<std::string> faults() const;

 private:
  std::vector<std::string> depth_faults() const;

  std::size_t frames_ = 0;
  std::shared_ptr<const Calibration> calibration_;
  DepthAlignment alignment_;
  std::size_t depth_pixels_ = 0;
  std::vector<float> depths_;       ///< a sample of the valid ones [m]
  std::vector<double> brightness_;  ///< mean of each color image, in [0, 255]
};

/// What is implausible in a camera: the principal point far from the center, pixels far from
/// square, or a field of view that no pinhole camera has.
std::vector<std::string> camera_faults(const CameraIntrinsics& camera);

}  // namespace mms
