#include "mms/dataset/lidar/scan_format.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/io/cloud/pcd_io.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kIntensityAt = 3 * sizeof(float);
constexpr std::size_t kNcltBytes = 8;
constexpr float kMaxTime = 1.0F;  // of a point, relative to its scan [s]

template <class T>
T value_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// The bytes of whole records.
std::string read_records(const fs::path& path, std::size_t record) {
  std::string bytes = read_file(path);
  if (bytes.empty()) throw DataError(path.string(), "is empty");
  if (bytes.size() % record != 0) {
    throw DataError(path.string(),
                    "has " + std::to_string(bytes.size()) + " bytes, not a multiple of " +
                        std::to_string(record),
                    "a point has " + std::to_string(record) + " bytes; the scan may be truncated");
  }
  return bytes;
}

float time_of(const char* record, const ScanFormat& format) {
  const char* at = record + format.time_at;
  if (format.time == PointTime::kFloatSeconds) return value_at<float>(at);
  return static_cast<float>(1e-9 * value_at<std::uint32_t>(at));
}

LidarScan read_float_records(const fs::path& path, const ScanFormat& format) {
  const std::string bytes = read_records(path, format.bytes);
  LidarScan scan;
  scan.points.reserve(bytes.size() / format.bytes);
  for (std::size_t at = 0; at < bytes.size(); at += format.bytes) {
    const char* record = bytes.data() + at;
    scan.points.emplace_back(value_at<float>(record), value_at<float>(record + 4),
                             value_at<float>(record + 8));
    if (format.has_intensity) scan.intensity.push_back(value_at<float>(record + kIntensityAt));
    if (format.time != PointTime::kNone) scan.time_offset.push_back(time_of(record, format));
  }
  return scan;
}

/// z is turned up.
LidarScan read_nclt(const fs::path& path) {
  constexpr float kUnit = 0.005F;     // [m]
  constexpr float kOffset = -100.0F;  // [m]
  const std::string bytes = read_records(path, kNcltBytes);
  LidarScan scan;
  for (std::size_t at = 0; at < bytes.size(); at += kNcltBytes) {
    const auto coordinate = [&](std::size_t axis) {
      return kUnit * static_cast<float>(value_at<std::uint16_t>(bytes.data() + at + 2 * axis)) +
             kOffset;
    };
    scan.points.emplace_back(coordinate(0), -coordinate(1), -coordinate(2));
    scan.intensity.push_back(static_cast<float>(value_at<std::uint8_t>(bytes.data() + at + 6)));
  }
  return scan;
}

LidarScan read_cloud_file(const fs::path& path) {
  PointCloudFile cloud = path.extension() == ".pcd" ? read_pcd(path) : read_ply(path);
  if (cloud.points.empty()) throw DataError(path.string(), "has no points");
  return {std::move(cloud.points), std::move(cloud.intensities), std::move(cloud.time_offsets)};
}

/// Scans with missing points have no such order.
void add_column_times(LidarScan& scan) {
  constexpr std::size_t kRows = 64;
  constexpr std::size_t kColumns = 1024;
  constexpr float kPeriod = 0.1F;  // [s]
  if (scan.points.size() != kRows * kColumns) return;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const std::size_t column = i / kRows;
    scan.time_offset.push_back(kPeriod * static_cast<float>(column) / kColumns);
  }
}

}  // namespace

LidarScan read_scan(const fs::path& path, const ScanFormat& format) {
  LidarScan scan = format.kind == ScanFormat::Kind::kNclt        ? read_nclt(path)
                   : format.kind == ScanFormat::Kind::kCloudFile ? read_cloud_file(path)
                                                                 : read_float_records(path, format);
  if (format.has_columns && scan.time_offset.empty()) add_column_times(scan);
  check_point_times(scan.time_offset, path);
  return scan;
}

void check_point_times(const std::vector<float>& times, const fs::path& path) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::abs(times[i]) <= kMaxTime) continue;  // false for NaN
    throw DataError(path.string(),
                    "the time of point " + std::to_string(i) + " is not within 1 s of the scan",
                    "times of points are in seconds, relative to the stamp of their scan");
  }
}

}  // namespace mms
