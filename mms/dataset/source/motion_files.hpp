#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "mms/core/frame.hpp"

namespace mms {

/// Files of wheels and gyroscope beside the frames of a recording.
struct MotionOptions {
  std::filesystem::path wheels{};  ///< empty: the recording's own; "none": none
  std::filesystem::path imu{};     ///< empty: the recording's own; "none": none
};

/// Measurements of wheels and gyroscope over a whole recording.
struct MotionRecording {
  MotionSamples samples;              ///< in order of time
  std::vector<std::string> facts;     ///< lines for `mms info`
  std::vector<std::string> warnings;  ///< non-fatal faults
};

/// Adds facts and warnings on measurements that were read.
/// @param wheels, imu  files or topics they are from
void describe_motion(MotionRecording& recording, const std::string& wheels, const std::string& imu);

/// Reads the files of the options, else odometry.csv or odometry.txt, and imu.csv, imu.txt or
/// imu0/data.csv of the folder; nothing where there are none. Of the latter, those with other
/// content are left out with a warning.
/// @throws FileError, DataError for files of the options that cannot be read.
MotionRecording read_motion_files(const std::filesystem::path& folder,
                                  const MotionOptions& options);

/// The last stamp of measurements that belong to a frame: a little after its last point, so that
/// times in between can be interpolated.
Timestamp motion_end(const Frame& frame);

/// Hands measurements to frames in order: each gets those since the frame before.
class MotionFeed {
 public:
  /// Those of a kind replace earlier ones.
  void add(MotionSamples samples);

  /// Moves those up to the end of the frame to it.
  void attach(Frame& frame);

 private:
  MotionSamples samples_;
  std::size_t wheels_ = 0;  ///< next one
  std::size_t imu_ = 0;     ///< next one
};

}  // namespace mms
