#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "mms/core/trajectory.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {

/// The files a recorder would leave, in one of the layouts that `open_dataset` reads: images, scans
/// and lists, and the exact instances/ beside them. The truth of the scene is not its matter.
class RecordingLayout {
 public:
  virtual ~RecordingLayout() = default;

  /// Writes the files of one frame. @throws FileError
  virtual void add(const SimulatedFrame& frame) = 0;

  /// Writes what lists the frames added. @param truth  their poses @throws FileError
  virtual void finish(const Trajectory& truth) = 0;

  /// Path of a frame's colour image below the recording's folder.
  virtual std::string color_file(const Frame& frame) const = 0;
};

/// TUM layout: rgb/, depth/, masks/, instances/ named by stamp, rgb.txt, depth.txt.
std::unique_ptr<RecordingLayout> tum_layout(const std::filesystem::path& folder,
                                            const SceneConfig& config, const SensorPreset& sensor);

/// KITTI's layout: velodyne/, point_times/, image_2/, masks/, instances/ named by number,
/// times.txt, poses.txt (of the camera).
std::unique_ptr<RecordingLayout> kitti_layout(const std::filesystem::path& folder,
                                              const SceneConfig& config,
                                              const SensorPreset& sensor);

/// The one for the sensor: KITTI's for a LiDAR, TUM's for a depth camera.
std::unique_ptr<RecordingLayout> layout_for(const std::filesystem::path& folder,
                                            const SceneConfig& config, const SensorPreset& sensor);

}  // namespace mms
