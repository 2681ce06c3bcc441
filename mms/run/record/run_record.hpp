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

/// What a run was of, run.json: what is needed to look at its recording again.
struct RunRecord {
  std::string data;          ///< recording as an absolute path, or a simulation's address
  std::string segmenter;     ///< "network", "masks" or "none"
  std::string masks;         ///< folder of label images; empty: the recording's own
  bool depth_camera = true;  ///< else a LiDAR
  double voxel_size = 0.0;   ///< of the map at its end [m]
  std::optional<CameraIntrinsics> camera;
};

/// What a run knows of a frame beside its pose and timing, a line of frames.csv.
struct FrameRecord {
  Timestamp stamp;
  std::int64_t index = 0;  ///< in the recording
  Status status = Status::kTracking;
  double dynamic_share = 0.0;
};

RunRecord record_of(const RunOptions& options, const std::optional<CameraIntrinsics>& camera,
                    bool depth_camera, double voxel_size);

/// Writes run.json, frames.csv and, where there is truth, truth.tum: the true poses of the frames
/// that have one, taken to the frame of the trajectory.
/// @throws FileError naming the file that cannot be written.
void write_run_record(const std::filesystem::path& folder, const RunRecord& record,
                      const RunLog& log);

/// @throws FileError when it cannot be read, DataError when it is no such file.
RunRecord read_run_record(const std::filesystem::path& file);
std::vector<FrameRecord> read_frame_records(const std::filesystem::path& file);

/// The true poses that match the estimated ones in time, in the frame of the estimate and with its
/// stamps, aligned over all of them.
Trajectory aligned_truth(const Trajectory& truth, const Trajectory& estimate);

}  // namespace mms
