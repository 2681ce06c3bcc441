#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>

#include "mms/dataset/recorder/recording_layout.hpp"
#include "mms/dataset/simulated/instance_annotations.hpp"
#include "mms/dataset/simulated/map_truth.hpp"
#include "mms/dataset/simulated/objects_truth.hpp"
#include "mms/io/text/output_folder.hpp"

namespace mms {

/// Writes a simulated recording with its ground truth, frame by frame. Besides the recording
/// (RecordingLayout) the folder contains groundtruth.txt, objects_truth.json, instances.json
/// (COCO), map_truth.ply (for depth cameras) and scene.yaml. Files are written atomically.
class SimulationWriter {
 public:
  /// @throws FileError if the folder cannot be written or contains other files
  /// (prepare_recording_folder).
  SimulationWriter(const std::filesystem::path& folder, const SceneConfig& config,
                   const SensorPreset& sensor, bool overwrite);

  /// Writes a frame; stamps must increase.
  /// @throws FileError
  void add(const SimulatedFrame& frame, const StampedPose& pose);

  /// Writes the files of the whole recording.
  /// @throws FileError, DataError if there was no frame.
  void finish();

  std::size_t annotations() const { return annotations_.annotations.size(); }
  std::size_t map_points() const { return map_points_; }

 private:
  std::filesystem::path folder_;
  FolderLock lock_;
  std::unique_ptr<RecordingLayout> layout_;
  Trajectory truth_;
  ObjectsTruth objects_;
  CocoDataset annotations_ = empty_annotations();
  MapTruth map_;
  std::size_t map_points_ = 0;
};

/// Options of `write_simulation`.
struct WriteOptions {
  double pose_rate = 200.0;      ///< of the poses in groundtruth_dense.txt [Hz]
  double static_spacing = 0.04;  ///< of the points in static_truth.ply [m]
  bool overwrite = false;        ///< replaces an earlier simulation
  /// Called after every frame; returning false ends the recording.
  std::function<bool(int done, int total)> progress = {};
};

/// Summary of a written recording.
struct WrittenRecording {
  int frames = 0;
  std::size_t annotations = 0;    ///< instances in all frames
  std::size_t static_points = 0;  ///< of static_truth.ply
  std::size_t map_points = 0;     ///< of map_truth.ply
};

/// Renders a scene into a folder: the files of SimulationWriter, groundtruth_dense.txt with poses
/// between the frames, and static_truth.ply with all static surfaces.
/// @throws FileError, DataError as SimulationWriter.
WrittenRecording write_simulation(SimulatedScene& scene, const std::filesystem::path& folder,
                                  const WriteOptions& options = {});

}  // namespace mms
