#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/run/record/run_log.hpp"
#include "mms/run/record/run_options.hpp"

namespace mms {

/// Input of a run, run.json: sufficient to process its recording again.
struct RunRecord {
  std::string data;            ///< absolute path of the recording, or address of a simulation
  std::string segmenter;       ///< "network", "masks" or "none"
  std::string masks;           ///< folder of label images; empty: the recording's own
  BagTopicNames topics;        ///< given for a bag
  CameraOptions given;         ///< calibration in place of the recording's
  std::optional<double> rate;  ///< [Hz], given for a recording without time stamps
  bool depth_camera = true;    ///< false: LiDAR
  double voxel_size = 0.0;     ///< of the final map [m]
  std::optional<CameraIntrinsics> camera;
};

/// Data of a frame beside pose and timing, a row of frames.csv.
struct FrameRecord {
  Timestamp stamp;
  std::int64_t index = 0;  ///< in the recording
  Status status = Status::kTracking;
  double dynamic_share = 0.0;
  std::optional<double> overruled_share;  ///< unknown of runs of earlier versions
};

/// A path that is the same in every working folder.
std::string absolute_path(const std::filesystem::path& path);

RunRecord record_of(const RunOptions& options, const std::optional<CameraIntrinsics>& camera,
                    bool depth_camera, double voxel_size);

/// Writes run.json, frames.csv and, with ground truth, truth.tum: the ground-truth poses in the
/// frame of the trajectory.
/// @throws FileError with the file that cannot be written.
void write_run_record(const std::filesystem::path& folder, const RunRecord& record,
                      const RunLog& log);

/// @throws FileError if it cannot be read; DataError if its content is invalid.
RunRecord read_run_record(const std::filesystem::path& file);
std::vector<FrameRecord> read_frame_records(const std::filesystem::path& file);

/// The ground-truth poses that match the estimated ones in time, aligned to the frame of the
/// estimate and with its stamps.
Trajectory aligned_truth(const Trajectory& truth, const Trajectory& estimate);

}  // namespace mms
