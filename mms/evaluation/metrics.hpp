#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mms/core/odometry_estimate.hpp"
#include "mms/evaluation/map/map_error.hpp"
#include "mms/evaluation/scores/metric_value.hpp"
#include "mms/evaluation/segmentation/mask_agreement.hpp"
#include "mms/evaluation/tracking/tracking_error.hpp"
#include "mms/evaluation/trajectory/drift.hpp"
#include "mms/evaluation/trajectory/trajectory_error.hpp"

namespace mms {

/// Statistics of times [ms]; percentiles by nearest rank.
struct TimeStatistics {
  double mean = 0.0;
  double p50 = 0.0;
  double p99 = 0.0;
};

/// All NaN without times.
TimeStatistics time_statistics(std::span<const double> milliseconds);

/// Real-time performance of a run.
struct RealtimeMetrics {
  TimeStatistics latency_ms;  ///< from the sensor's frame to its result
  double latency_max_ms = 0.0;
  std::int64_t dropped = 0;        ///< frames
  std::int64_t without_masks = 0;  ///< frames without masks because the network was busy
};

/// Localization in the map of earlier sessions.
struct EarlierMapMetrics {
  std::int64_t sessions = 0;          ///< of the map
  std::int64_t keyframes = 0;         ///< of the map
  std::int64_t closed = 0;            ///< accepted loops to them
  std::optional<double> localized_s;  ///< stamp of the first one, from the first frame [s]
};

/// Sessions of a run. Another one begins where the sensor is lost for seconds.
struct SessionMetrics {
  std::int64_t begun = 0;
  std::int64_t in_map = 0;          ///< those whose place in the map is known at the end
  std::int64_t frames_outside = 0;  ///< frames whose place in it is not known
};

/// Loop closure of a run.
struct LoopMetrics {
  std::int64_t keyframes = 0;                    ///< of the global map
  std::int64_t checked = 0;                      ///< possible loops
  std::int64_t closed = 0;                       ///< accepted loops
  std::int64_t relocalized = 0;                  ///< lost frames whose place was recognized
  std::optional<SessionMetrics> sessions;        ///< with more than one
  std::optional<EarlierMapMetrics> earlier_map;  ///< with a map file
  std::optional<TrajectoryError> trajectory;     ///< of the corrected poses; with ground truth
};

/// Summary of a run: the content of metrics.json.
struct RunMetrics {
  std::int64_t frames = 0;          ///< processed
  std::int64_t frames_skipped = 0;  ///< damaged, or dropped in real time
  double rate_hz = 0.0;             ///< frames per second of wall time
  TimeStatistics ms_per_frame;
  std::vector<std::pair<std::string, TimeStatistics>> stages;  ///< in pipeline order
  double peak_memory_mb = 0.0;                                 ///< [MB, 10^6 bytes]
  std::array<std::int64_t, kStatusCount> status{};             ///< number of frames per mms::Status
  double dynamic_share = 0.0;                                  ///< mean over the frames, in [0, 1]
  std::int64_t implausible_masks = 0;  ///< dropped, since they cannot be objects in 3D
  std::int64_t overruled_frames = 0;   ///< frames with masks that the pose did not follow
  double overruled_share = 0.0;        ///< mean share of these points over all frames, in [0, 1]
  std::int64_t tracks = 0;             ///< confirmed tracks
  std::optional<RealtimeMetrics> realtime;    ///< of runs at the sensor's rate
  std::optional<TrajectoryError> trajectory;  ///< with ground truth
  std::optional<Drift> drift;                 ///< with ground truth
  std::optional<LoopMetrics> loops;           ///< with a global map
  std::optional<MapError> map;                ///< with a ground-truth map
  std::optional<MaskAgreement> masks;         ///< with masks to compare
  std::optional<TrackingError> objects;       ///< with ground-truth objects
  std::optional<TrackingError> live_objects;  ///< of the live output; with ground-truth objects
  bool stood_still = true;  ///< by ground truth; tables omit the drift of a moving sensor
};

/// Version of the keys in metrics.json, its `version`. Version 1 had no such key.
inline constexpr int kMetricsVersion = 2;

/// The JSON object, indented, with a final newline. `realtime`, `trajectory`, `drift`,
/// `loops`, `map`, `masks`, `objects` and `live_objects` only if present; all status names always.
/// Keys end with their unit: _s, _m, _mps, _deg, _hz, _mb, _pct; all others are counts.
std::string to_json(const RunMetrics& metrics);

/// Writes `to_json` to a file atomically.
/// @throws FileError
void write_metrics(const std::filesystem::path& path, const RunMetrics& metrics);

/// The main metrics for the terminal and the report: trajectory, loops, map, objects, masks, speed.
/// Values that are undefined or do not apply are omitted; a section without values, too. A section
/// with a comparison to ground truth has a rating (docs/evaluation.md).
std::vector<MetricSection> metric_sections(const RunMetrics& metrics);

}  // namespace mms
