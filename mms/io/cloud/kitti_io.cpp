#include "mms/io/cloud/kitti_io.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace {

static_assert(std::endian::native == std::endian::little, "records are written bytewise");

std::string_view bytes_of(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

}  // namespace

void write_kitti_scan(const std::filesystem::path& path, const LidarScan& scan) {
  if (!scan.intensity.empty() && scan.intensity.size() != scan.points.size()) {
    throw DataError(path.string(), "has " + std::to_string(scan.points.size()) + " points and " +
                                       std::to_string(scan.intensity.size()) + " intensities");
  }
  std::vector<float> records;
  records.reserve(4 * scan.points.size());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    const float intensity = scan.intensity.empty() ? 0.0F : scan.intensity[i];
    records.insert(records.end(), {p.x(), p.y(), p.z(), intensity});
  }
  write_file(path, bytes_of(records));
}

std::vector<float> read_point_times(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  if (bytes.size() % sizeof(float) != 0) {
    throw DataError(path.string(),
                    "has " + std::to_string(bytes.size()) + " bytes, not a multiple of 4",
                    "a time is a float32 in seconds; the file may be truncated");
  }
  std::vector<float> times(bytes.size() / sizeof(float));
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(times.data()));
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::isfinite(times[i])) continue;
    throw DataError(path.string(), "the time of point " + std::to_string(i) + " is not finite");
  }
  return times;
}

void write_point_times(const std::filesystem::path& path, const std::vector<float>& times) {
  write_file(path, bytes_of(times));
}

}  // namespace mms
