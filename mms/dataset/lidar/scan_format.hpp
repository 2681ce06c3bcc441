#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "mms/core/frame.hpp"

namespace mms {

/// Type of a point's time in a record, relative to the scan's stamp.
enum class PointTime { kNone, kFloatSeconds, kIntegerNanoseconds };

/// How a scan is stored in a file.
struct ScanFormat {
  enum class Kind {
    kFloats,     ///< records of float32 alone, x y z first
    kRecords,    ///< other records that begin with x y z as float32
    kNclt,       ///< records of NCLT: x y z as uint16 in 5 mm, intensity, laser; z is down
    kCloudFile,  ///< .pcd or .ply
  };

  Kind kind = Kind::kFloats;
  std::size_t bytes = 16;     ///< of a record
  bool has_intensity = true;  ///< a float32 after z
  PointTime time = PointTime::kNone;
  std::size_t time_at = 0;  ///< byte of the time in a record
  /// Points of a 64x1024 scan at 10 Hz, column by column: their times follow from their order.
  bool has_columns = false;
};

/// Reads a scan. Keeps NaN and infinite points.
/// @throws FileError if the file cannot be read; DataError if it is empty or damaged, or the time
/// of a point is more than 1 s from the scan's.
LidarScan read_scan(const std::filesystem::path& path, const ScanFormat& format);

/// @param path  of the file with the times [s]
/// @throws DataError if the time of a point is more than 1 s from the scan's
void check_point_times(const std::vector<float>& times, const std::filesystem::path& path);

}  // namespace mms
