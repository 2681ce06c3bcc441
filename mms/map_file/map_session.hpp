#pragma once

#include <cstdint>
#include <string>

#include "mms/core/calibration.hpp"
#include "mms/core/time.hpp"

namespace mms {

/// A run whose map is in a map file.
struct MapSession {
  std::string name;         ///< of the recording
  std::string program;      ///< version that made it
  std::string settings;     ///< YAML
  std::int64_t frames = 0;  ///< of the recording that were processed
  Timestamp begin;          ///< stamp of the first frame
  Timestamp end;            ///< stamp of the last one
  double voxel_size = 0.0;  ///< of its static map [m]
  CameraIntrinsics camera;  ///< of its depth images; of LiDAR scans none
};

}  // namespace mms
