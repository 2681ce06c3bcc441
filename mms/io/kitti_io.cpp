#include "mms/io/kitti_io.hpp"

#include <cstring>

#include "mms/core/error.hpp"
#include "mms/io/files.hpp"

namespace mms {

LidarScan read_kitti_scan(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  float record[4];
  if (bytes.empty()) throw DataError(path.string(), "is an empty scan of 0 bytes");
  if (bytes.size() % sizeof record != 0) {
    throw DataError(path.string(),
                    "has " + std::to_string(bytes.size()) + " bytes, not a multiple of 16",
                    "a point is x y z reflectance as float32; the scan may be truncated");
  }
  const std::size_t count = bytes.size() / sizeof record;
  LidarScan scan;
  scan.points.reserve(count);
  scan.intensity.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(record, bytes.data() + i * sizeof record, sizeof record);
    scan.points.emplace_back(record[0], record[1], record[2]);
    scan.intensity.push_back(record[3]);
  }
  return scan;
}

}  // namespace mms
