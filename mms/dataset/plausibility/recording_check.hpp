#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/dataset/plausibility/edge_alignment.hpp"
#include "mms/dataset/plausibility/edge_delay.hpp"
#include "mms/dataset/plausibility/image_motion.hpp"

namespace mms {

/// Checks over some frames of a recording whether depth, masks, calibration and images are
/// plausible.
class RecordingCheck {
 public:
  /// Frames to add, at least a few frames apart.
  static constexpr std::size_t kFrames = 8;

  /// Frames in sequence to add.
  static constexpr std::size_t kSequence = 16;

  void add(const Frame& frame);
  std::size_t frames() const { return frames_; }

  /// Adds a frame of a sequence, to check times and motion. A gap in the indices begins a new one.
  void add_in_sequence(const Frame& frame);
  std::size_t frames_in_sequence() const { return in_sequence_; }

  /// What is implausible, each in one sentence with figures and a remedy. Frames without depth
  /// images are only checked for their calibration.
  std::vector<std::string> faults() const;

 private:
  std::vector<std::string> depth_faults() const;
  std::vector<std::string> edge_faults() const;

  std::size_t frames_ = 0;
  std::size_t in_sequence_ = 0;
  std::int64_t last_index_ = 0;  ///< of the sequence
  std::shared_ptr<const Calibration> calibration_;
  EdgeAlignment depth_alignment_;
  EdgeAlignment mask_alignment_;
  EdgeDelay depth_delay_;
  EdgeDelay mask_delay_;
  ImageMotion motion_;
  std::size_t depth_pixels_ = 0;
  std::vector<float> depths_;       ///< a sample of the valid ones [m]
  std::vector<double> brightness_;  ///< mean of each color image, in [0, 255]
};

/// What is implausible in a camera: the principal point far from the center, pixels far from
/// square, or a field of view that no pinhole camera has.
std::vector<std::string> camera_faults(const CameraIntrinsics& camera);

}  // namespace mms
