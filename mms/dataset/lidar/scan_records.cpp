#include "mms/dataset/lidar/scan_records.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "mms/core/error.hpp"
#include "mms/core/upper_median.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr int kUsual = 4;
constexpr std::array kCandidates = {4, 5, 3, 6};
constexpr std::size_t kScans = 5;          // that are looked at
constexpr std::size_t kMinPoints = 100;    // of a scan to judge distances by
constexpr double kMaxDistanceRatio = 0.5;  // of another candidate's distance to the usual one's
constexpr const char* kNuScenesEnding = ".pcd.bin";

/// Bytes of the first scans that are not empty.
std::vector<std::uintmax_t> first_sizes(const std::vector<fs::path>& scans) {
  std::vector<std::uintmax_t> sizes;
  for (const fs::path& scan : scans) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(scan, error);
    if (!error && size > 0) sizes.push_back(size);
    if (sizes.size() == kScans) break;
  }
  return sizes;
}

std::size_t whole_scans(const std::vector<std::uintmax_t>& sizes, int floats) {
  const std::uintmax_t record = static_cast<std::uintmax_t>(floats) * sizeof(float);
  return static_cast<std::size_t>(
      std::count_if(sizes.begin(), sizes.end(), [&](std::uintmax_t n) { return n % record == 0; }));
}

/// Median distance between points that follow each other in the first readable scan [m].
std::optional<double> median_distance(const std::vector<fs::path>& scans, int floats) {
  for (std::size_t i = 0; i < std::min(kScans, scans.size()); ++i) {
    try {
      const auto points = read_scan(scans[i], float_format(floats)).points;
      if (points.size() < kMinPoints) continue;
      std::vector<double> distances;
      for (std::size_t k = 1; k < points.size(); ++k) {
        if (points[k].isZero() || points[k - 1].isZero()) continue;  // no return
        const double distance = (points[k] - points[k - 1]).norm();
        distances.push_back(std::isfinite(distance) ? distance
                                                    : std::numeric_limits<double>::infinity());
      }
      if (distances.empty()) continue;
      return upper_median(std::move(distances));
    } catch (const Error&) {
      continue;
    }
  }
  return std::nullopt;
}

}  // namespace

ScanFormat float_format(int floats) {
  ScanFormat format;
  format.bytes = static_cast<std::size_t>(floats) * sizeof(float);
  format.has_intensity = floats > 3;
  return format;
}

int floats_per_point(const std::vector<fs::path>& scans) {
  if (scans.front().string().ends_with(kNuScenesEnding)) return 5;
  const std::vector<std::uintmax_t> sizes = first_sizes(scans);
  std::size_t most = 0;
  for (const int floats : kCandidates) most = std::max(most, whole_scans(sizes, floats));
  int best = kUsual;
  const bool usual_is_whole = whole_scans(sizes, kUsual) == most;
  auto least = usual_is_whole ? median_distance(scans, kUsual) : std::nullopt;
  if (usual_is_whole && !least) return kUsual;
  for (const int floats : kCandidates) {
    if (floats == kUsual || whole_scans(sizes, floats) < most) continue;
    const auto distance = median_distance(scans, floats);
    if (!distance || (least && *distance >= kMaxDistanceRatio * *least)) continue;
    least = distance;
    best = floats;
  }
  return best;
}

}  // namespace mms
