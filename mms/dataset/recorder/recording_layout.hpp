#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "mms/core/trajectory.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {

/// Writes images, scans, lists and the exact instances/ in one of the layouts of `open_dataset`;
/// the scene's ground truth is written elsewhere.
class RecordingLayout {
 public:
  virtual ~RecordingLayout() = default;

  /// Writes the files of one frame. @throws FileError
  virtual void add(const SimulatedFrame& frame) = 0;

  /// Writes the lists of the added frames.
  /// @param truth  their poses
  /// @throws FileError
  virtual void finish(const Trajectory& truth) = 0;

  /// Path of a frame's color image in the recording's folder.
  virtual std::string color_file(const Frame& frame) const = 0;
};

/// TUM layout: rgb/, depth/, masks/, instances/ named by stamp, rgb.txt, depth.txt.
std::unique_ptr<RecordingLayout> tum_layout(const std::filesystem::path& folder,
                                            const SceneConfig& config, const SensorPreset& sensor);

/// KITTI layout: velodyne/, point_times/, image_2/, masks/, instances/ named by number, times.txt,
/// poses.txt (of the camera).
std::unique_ptr<RecordingLayout> kitti_layout(const std::filesystem::path& folder,
                                              const SceneConfig& config,
                                              const SensorPreset& sensor);

/// The layout for the sensor: KITTI for a LiDAR, TUM for a depth camera.
std::unique_ptr<RecordingLayout> layout_for(const std::filesystem::path& folder,
                                            const SceneConfig& config, const SensorPreset& sensor);

}  // namespace mms
