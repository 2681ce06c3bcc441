#include "mms/evaluation/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>

#include "mms/evaluation/scores/metric_json.hpp"
#include "mms/evaluation/scores/statistics.hpp"
#include "mms/io/text/atomic_file.hpp"

namespace mms {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSecondsPerMillisecond = 1e-3;

Json json_of(const TimeStatistics& times) {
  return {{"mean", kSecondsPerMillisecond * times.mean},
          {"p50", kSecondsPerMillisecond * times.p50},
          {"p99", kSecondsPerMillisecond * times.p99}};
}

Json stages_json(const RunMetrics& metrics) {
  Json object = Json::object();
  for (const auto& [name, times] : metrics.stages) object[name] = json_of(times);
  return object;
}

Json status_json(const RunMetrics& metrics) {
  Json object = Json::object();
  for (int i = 0; i < kStatusCount; ++i) {
    object[std::string(to_string(static_cast<Status>(i)))] =
        metrics.status[static_cast<std::size_t>(i)];
  }
  return object;
}

Json realtime_json(const RealtimeMetrics& metrics) {
  Json latency = json_of(metrics.latency_ms);
  latency["max"] = kSecondsPerMillisecond * metrics.latency_max_ms;
  return {{"latency_s", std::move(latency)},
          {"frames_dropped", metrics.dropped},
          {"frames_without_masks", metrics.without_masks}};
}

Json loops_json(const LoopMetrics& metrics) {
  Json object = {{"keyframes", metrics.keyframes},
                 {"checked", metrics.checked},
                 {"closed", metrics.closed},
                 {"relocalized", metrics.relocalized}};
  if (metrics.sessions) {
    object["sessions"] = {{"begun", metrics.sessions->begun},
                          {"in_map", metrics.sessions->in_map},
                          {"frames_outside", metrics.sessions->frames_outside}};
  }
  if (metrics.earlier_map) {
    const EarlierMapMetrics& map = *metrics.earlier_map;
    object["earlier_map"] = {{"sessions", map.sessions},
                             {"keyframes", map.keyframes},
                             {"closed", map.closed},
                             {"localized_s", map.localized_s ? Json(*map.localized_s) : Json()}};
  }
  if (metrics.trajectory) object["trajectory"] = json_object(metric_values(*metrics.trajectory));
  return object;
}

MetricValue count(const char* meaning, std::int64_t value) {
  return {"", meaning, static_cast<double>(value), "", 0};
}

/// Rating by two limits; the larger value is better.
std::string rated(double value, double good, double fair) {
  if (std::isnan(value)) return "";
  return value >= good ? "good" : value >= fair ? "fair" : "poor";
}

/// Limits of the error: a part that any sensor's noise causes, and a share of the path, by which
/// the drift of an odometry is given (KITTI odometry benchmark).
std::string rating_of(const TrajectoryError& error) {
  constexpr double kGood = 0.02;        // [m]
  constexpr double kGoodShare = 0.005;  // of the path
  constexpr double kFair = 0.10;        // [m]
  constexpr double kFairShare = 0.02;   // of the path
  return rated(-error.ate_rmse_m, -(kGood + kGoodShare * error.path_m),
               -(kFair + kFairShare * error.path_m));
}

void add(MetricSection& section, std::vector<MetricValue> values,
         std::initializer_list<std::string_view> omitted = {}) {
  for (MetricValue& item : values) {
    const bool shown = std::find(omitted.begin(), omitted.end(), item.key) == omitted.end();
    if (shown && std::isfinite(item.value)) section.values.push_back(std::move(item));
  }
}

MetricSection trajectory_section(const RunMetrics& metrics) {
  MetricSection section{"Trajectory", "", {}};
  add(section, {count("frames", metrics.frames)});
  const auto add_if_any = [&section](const char* meaning, std::int64_t frames) {
    if (frames > 0) add(section, {count(meaning, frames)});
  };
  const auto frames_of = [&metrics](Status status) {
    return metrics.status[static_cast<std::size_t>(status)];
  };
  add_if_any("frames skipped", metrics.frames_skipped);
  add_if_any("frames degenerate", frames_of(Status::kDegenerate));
  add_if_any("frames lost, poses predicted", frames_of(Status::kLost));
  if (metrics.trajectory) {
    // The pose of a lost frame is a prediction, which is right where the sensor stands still.
    const bool is_mostly_lost = 2 * frames_of(Status::kLost) > metrics.frames;
    section.rating = is_mostly_lost ? "poor" : rating_of(*metrics.trajectory);
    add(section, metric_values(*metrics.trajectory), {"poses"});
  }
  if (metrics.drift && metrics.stood_still) add(section, metric_values(*metrics.drift), {"poses"});
  return section;
}

/// What loops change, if there are any.
MetricSection loops_section(const RunMetrics& metrics) {
  MetricSection section{"Loops", "", {}};
  if (!metrics.loops) return section;
  if (metrics.loops->relocalized > 0) {
    add(section, {count("relocalized after lost frames", metrics.loops->relocalized)});
  }
  if (metrics.loops->sessions) {
    add(section, {count("sessions, since the sensor was lost", metrics.loops->sessions->begun),
                  count("sessions in the map", metrics.loops->sessions->in_map),
                  count("frames outside the map", metrics.loops->sessions->frames_outside)});
  }
  if (metrics.loops->earlier_map && metrics.loops->earlier_map->localized_s) {
    add(section,
        {{"", "localized in the map after", *metrics.loops->earlier_map->localized_s, "s", 2},
         count("loops to the map", metrics.loops->earlier_map->closed)});
  }
  if (metrics.loops->closed == 0) return section;
  add(section, {count("loops closed", metrics.loops->closed)});
  if (metrics.loops->trajectory) {
    section.rating = rating_of(*metrics.loops->trajectory);
    add(section,
        {{"", "ATE rmse of the corrected poses", metrics.loops->trajectory->ate_rmse_m, "m", 4}});
  }
  return section;
}

MetricSection map_section(const RunMetrics& metrics) {
  constexpr double kGood = 95.0;  // AA [%]: one point in twenty is wrong
  constexpr double kFair = 85.0;
  MetricSection section{"Map", "", {}};
  if (!metrics.map) return section;
  section.rating = rated(metrics.map->AA, kGood, kFair);
  add(section, metric_values(*metrics.map), {"ha_pct"});
  return section;
}

MetricSection objects_section(const RunMetrics& metrics) {
  constexpr double kGood = 0.85;  // IDF1: one box in seven is wrong
  constexpr double kFair = 0.60;
  MetricSection section{"Objects", "", {}};
  add(section, {count("tracked objects", metrics.tracks),
                {"", "dynamic share of the points", 100.0 * metrics.dynamic_share, "%", 1}});
  if (metrics.objects) {
    section.rating = rated(metrics.objects->idf1, kGood, kFair);
    add(section, metric_values(*metrics.objects));
  }
  return section;
}

MetricSection masks_section(const RunMetrics& metrics) {
  MetricSection section{"Masks", "", {}};
  if (metrics.masks) add(section, metric_values(*metrics.masks));
  if (metrics.implausible_masks > 0) {
    add(section, {count("implausible masks", metrics.implausible_masks)});
  }
  if (metrics.overruled_frames > 0) {
    add(section, {count("frames with overruled masks", metrics.overruled_frames)});
  }
  return section;
}

MetricSection speed_section(const RunMetrics& metrics) {
  MetricSection section{"Speed", "", {}};
  add(section, {{"", "rate", metrics.rate_hz, "Hz", 1},
                {"", "time per frame, mean", metrics.ms_per_frame.mean, "ms", 1},
                {"", "time per frame, median", metrics.ms_per_frame.p50, "ms", 1},
                {"", "time per frame, p99", metrics.ms_per_frame.p99, "ms", 1},
                {"", "peak memory", metrics.peak_memory_mb, "MB", 0}});
  if (!metrics.realtime) return section;
  add(section, {{"", "latency, mean", metrics.realtime->latency_ms.mean, "ms", 1},
                {"", "latency, p99", metrics.realtime->latency_ms.p99, "ms", 1},
                {"", "latency, largest", metrics.realtime->latency_max_ms, "ms", 1},
                count("frames dropped", metrics.realtime->dropped),
                count("frames without new masks", metrics.realtime->without_masks)});
  return section;
}

}  // namespace

TimeStatistics time_statistics(std::span<const double> milliseconds) {
  return {mean(milliseconds), percentile(milliseconds, 50.0), percentile(milliseconds, 99.0)};
}

std::string to_json(const RunMetrics& metrics) {
  Json object = {{"version", kMetricsVersion},
                 {"frames", metrics.frames},
                 {"frames_skipped", metrics.frames_skipped},
                 {"rate_hz", metrics.rate_hz},
                 {"time_per_frame_s", json_of(metrics.ms_per_frame)},
                 {"stages_s", stages_json(metrics)},
                 {"peak_memory_mb", metrics.peak_memory_mb},
                 {"status", status_json(metrics)},
                 {"dynamic_pct", 100.0 * metrics.dynamic_share},
                 {"implausible_masks", metrics.implausible_masks},
                 {"overruled_frames", metrics.overruled_frames},
                 {"overruled_pct", 100.0 * metrics.overruled_share},
                 {"tracks", metrics.tracks}};
  if (metrics.realtime) object["realtime"] = realtime_json(*metrics.realtime);
  if (metrics.trajectory) object["trajectory"] = json_object(metric_values(*metrics.trajectory));
  if (metrics.drift) object["drift"] = json_object(metric_values(*metrics.drift));
  if (metrics.loops) object["loops"] = loops_json(*metrics.loops);
  if (metrics.map) object["map"] = json_object(metric_values(*metrics.map));
  if (metrics.masks) object["masks"] = json_object(metric_values(*metrics.masks));
  if (metrics.objects) object["objects"] = json_object(metric_values(*metrics.objects));
  if (metrics.live_objects) {
    object["live_objects"] = json_object(metric_values(*metrics.live_objects));
  }
  return object.dump(2) + "\n";
}

void write_metrics(const std::filesystem::path& path, const RunMetrics& metrics) {
  write_file(path, to_json(metrics));
}

std::vector<MetricSection> metric_sections(const RunMetrics& metrics) {
  std::vector<MetricSection> sections = {trajectory_section(metrics), loops_section(metrics),
                                         map_section(metrics),        objects_section(metrics),
                                         masks_section(metrics),      speed_section(metrics)};
  std::erase_if(sections, [](const MetricSection& section) { return section.values.empty(); });
  return sections;
}

}  // namespace mms
