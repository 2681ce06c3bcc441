#include "mms/evaluation/metrics.hpp"

#include <string>

#include "mms/evaluation/scores/metric_json.hpp"
#include "mms/evaluation/scores/statistics.hpp"
#include "mms/io/text/atomic_file.hpp"

namespace mms {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const TimeStatistics& times) {
  return {{"mean", times.mean}, {"p50", times.p50}, {"p99", times.p99}};
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
  latency["max"] = metrics.latency_max_ms;
  return {{"latency_ms", std::move(latency)},
          {"frames_dropped", metrics.dropped},
          {"frames_without_masks", metrics.without_masks}};
}

std::vector<MetricValue> metric_values(const RealtimeMetrics& metrics) {
  return {{"latency_mean", "latency, mean", metrics.latency_ms.mean, "ms", 1},
          {"latency_p99", "latency, p99", metrics.latency_ms.p99, "ms", 1},
          {"latency_max", "latency, largest", metrics.latency_max_ms, "ms", 1},
          {"frames_dropped", "frames dropped", static_cast<double>(metrics.dropped), "", 0},
          {"frames_without_masks", "frames without new masks",
           static_cast<double>(metrics.without_masks), "", 0}};
}

void append(std::vector<MetricValue>& values, const std::vector<MetricValue>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

}  // namespace

TimeStatistics time_statistics(std::span<const double> milliseconds) {
  return {mean(milliseconds), percentile(milliseconds, 50.0), percentile(milliseconds, 99.0)};
}

std::string to_json(const RunMetrics& metrics) {
  Json object = {{"frames", metrics.frames},
                 {"frames_skipped", metrics.frames_skipped},
                 {"hz", metrics.hz},
                 {"ms_per_frame", json_of(metrics.ms_per_frame)},
                 {"stages", stages_json(metrics)},
                 {"peak_rss_mb", metrics.peak_rss_mb},
                 {"status", status_json(metrics)},
                 {"dynamic_share", metrics.dynamic_share},
                 {"implausible_masks", metrics.implausible_masks},
                 {"overruled_frames", metrics.overruled_frames},
                 {"overruled_share", metrics.overruled_share},
                 {"tracks", metrics.tracks}};
  if (metrics.realtime) object["realtime"] = realtime_json(*metrics.realtime);
  if (metrics.trajectory) object["trajectory"] = json_object(metric_values(*metrics.trajectory));
  if (metrics.drift) object["drift"] = json_object(metric_values(*metrics.drift));
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

std::vector<MetricValue> metric_values(const RunMetrics& metrics) {
  std::vector<MetricValue> values = {
      {"frames", "frames", static_cast<double>(metrics.frames), "", 0},
      {"frames_skipped", "frames skipped", static_cast<double>(metrics.frames_skipped), "", 0},
      {"hz", "rate", metrics.hz, "Hz", 1},
      {"ms_mean", "time per frame, mean", metrics.ms_per_frame.mean, "ms", 1},
      {"ms_p50", "time per frame, median", metrics.ms_per_frame.p50, "ms", 1},
      {"ms_p99", "time per frame, p99", metrics.ms_per_frame.p99, "ms", 1},
      {"peak_rss_mb", "peak memory", metrics.peak_rss_mb, "MiB", 0},
      {"dynamic_share", "dynamic share of the points", 100.0 * metrics.dynamic_share, "%", 1},
      {"implausible_masks", "implausible masks", static_cast<double>(metrics.implausible_masks), "",
       0},
      {"overruled_frames", "frames with overruled masks",
       static_cast<double>(metrics.overruled_frames), "", 0},
      {"tracks", "tracked objects", static_cast<double>(metrics.tracks), "", 0}};
  if (metrics.realtime) append(values, metric_values(*metrics.realtime));
  if (metrics.trajectory) append(values, metric_values(*metrics.trajectory));
  if (metrics.drift && metrics.stood_still) {
    std::vector<MetricValue> drift = metric_values(*metrics.drift);
    std::erase_if(drift, [](const MetricValue& item) { return item.key == "poses"; });
    append(values, drift);
  }
  if (metrics.map) {
    std::vector<MetricValue> map = metric_values(*metrics.map);
    std::erase_if(map, [](const MetricValue& item) { return item.key == "HA"; });
    append(values, map);
  }
  if (metrics.masks) append(values, metric_values(*metrics.masks));
  if (metrics.objects) append(values, metric_values(*metrics.objects));
  return values;
}

}  // namespace mms
