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

/// All NaN for no times.
TimeStatistics time_statistics(std::span<const double> milliseconds);

/// How a run kept up with its sensor.
struct RealtimeMetrics {
  TimeStatistics latency_ms;  ///< from the sensor's giving a frame to its result
  double latency_max_ms = 0.0;
  std::int64_t dropped = 0;        ///< frames
  std::int64_t without_masks = 0;  ///< frames that the network had no time for
};

/// What one run is summed up in: the content of metrics.json.
struct RunMetrics {
  std::int64_t frames = 0;          ///< processed
  std::int64_t frames_skipped = 0;  ///< unreadable, or dropped to keep up
  double hz = 0.0;                  ///< frames per second of wall time
  TimeStatistics ms_per_frame;
  std::vector<std::pair<std::string, TimeStatistics>> stages;  ///< in the order of the pipeline
  double peak_rss_mb = 0.0;                                    ///< [MiB]
  std::array<std::int64_t, kStatusCount> status{};             ///< frames of each mms::Status
  double dynamic_share = 0.0;                                  ///< mean over the frames, in [0, 1]
  std::int64_t tracks = 0;                                     ///< dynamic objects confirmed
  std::optional<RealtimeMetrics> realtime;                     ///< of a run at the sensor's pace
  std::optional<TrajectoryError> trajectory;                   ///< where truth is there
  std::optional<Drift> drift;                                  ///< where truth is there
  std::optional<MapError> map;                                 ///< where the true map is known
  std::optional<MaskAgreement> masks;                          ///< where masks to compare are
  std::optional<TrackingError> objects;                        ///< where the true ones are known
  std::optional<TrackingError> live_objects;                   ///< as known at once; there too
  bool stood_still = true;  ///< by the truth; for a moving sensor drift is left out of tables
};

/// The JSON object with the contract's keys, indented, ended by a newline; `realtime`,
/// `trajectory`, `drift`, `map`, `masks`, `objects` and `live_objects` only where they are there,
/// every status name always.
std::string to_json(const RunMetrics& metrics);

/// Writes `to_json` to a file, at once or not at all. @throws FileError
void write_metrics(const std::filesystem::path& path, const RunMetrics& metrics);

/// The main ones of them as a flat table for the terminal and the report.
std::vector<MetricValue> metric_values(const RunMetrics& metrics);

}  // namespace mms
