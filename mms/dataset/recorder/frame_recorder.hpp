#pragma once

#include <filesystem>
#include <memory>

#include "mms/core/frame.hpp"
#include "mms/core/trajectory.hpp"

namespace mms {

/// Writes the frames of any source as a recording for `open_dataset`.
class FrameRecorder {
 public:
  virtual ~FrameRecorder() = default;

  /// Adds a frame; all must be of the same kind.
  /// @throws FileError, DataError
  virtual void add(const Frame& frame) = 0;

  /// Writes the files of the whole recording.
  /// @param truth  poses of the sensor; may be empty
  /// @throws FileError if a file cannot be written.
  virtual void finish(const Trajectory& truth) = 0;
};

/// A ROS 1 bag (x.bag) or MCAP file of ROS 2 (x.mcap). Depth cameras: /camera/color/image_raw
/// (rgb8), /camera/color/camera_info, /camera/aligned_depth_to_color/image_raw (16UC1 if the depth
/// is in millimeters, else 32FC1 in meters). LiDARs: /points; with a camera also the color topics
/// and /tf_static. Masks are label images in /camera/mask/image_raw, poses are in /ground_truth
/// (PoseStamped).
/// @param compressed  images as JPEG, and depth in millimeters as PNG
/// @throws FileError if the file cannot be created.
std::unique_ptr<FrameRecorder> record_bag(const std::filesystem::path& path, bool compressed);

/// A folder in TUM layout (depth cameras) or KITTI layout (LiDARs), depending on the first frame;
/// images are PNG.
/// @throws FileError if the folder cannot be created or is not empty.
std::unique_ptr<FrameRecorder> record_folder(const std::filesystem::path& folder);

}  // namespace mms
