#pragma once

#include <filesystem>
#include <memory>

#include "mms/core/frame.hpp"
#include "mms/core/trajectory.hpp"

namespace mms {

/// Writes the frames of any source as a recording that `open_dataset` reads.
class FrameRecorder {
 public:
  virtual ~FrameRecorder() = default;

  /// Adds a frame; all have to be of the same kind. @throws FileError, DataError
  virtual void add(const Frame& frame) = 0;

  /// Writes what is of the whole recording. @param truth  poses of the sensor; may be empty
  /// @throws FileError when that cannot be written.
  virtual void finish(const Trajectory& truth) = 0;
};

/// A ROS 1 bag. Depth cameras: /camera/color/image_raw (rgb8), /camera/color/camera_info,
/// /camera/aligned_depth_to_color/image_raw (16UC1 where the depth is in millimetres, else 32FC1 in
/// metres). LiDARs: /points, with a camera those of colour and /tf_static besides. Masks are label
/// images of /camera/mask/image_raw, poses those of /ground_truth (PoseStamped).
/// @param compressed  images as JPEG, and depth in millimetres as PNG
/// @throws FileError when the file cannot be made.
std::unique_ptr<FrameRecorder> record_bag(const std::filesystem::path& path, bool compressed);

/// A folder in TUM layout (depth cameras) or KITTI's (LiDARs), as the first frame is of; images are
/// PNG. @throws FileError when the folder cannot be made or is not empty.
std::unique_ptr<FrameRecorder> record_folder(const std::filesystem::path& folder);

}  // namespace mms
