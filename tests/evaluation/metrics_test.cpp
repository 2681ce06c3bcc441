#include "mms/evaluation/metrics.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace mms {
namespace {

RunMetrics sample() {
  RunMetrics metrics;
  metrics.frames = 120;
  metrics.frames_skipped = 2;
  metrics.hz = 12.5;
  metrics.ms_per_frame = {80.0, 79.0, 110.0};
  metrics.stages = {{"segmentation", {40.0, 39.0, 60.0}}, {"fusion", {10.0, 9.0, 20.0}}};
  metrics.peak_rss_mb = 256.0;
  metrics.status[static_cast<std::size_t>(Status::kTracking)] = 119;
  metrics.status[static_cast<std::size_t>(Status::kInitialized)] = 1;
  metrics.dynamic_share = 0.25;
  metrics.implausible_masks = 5;
  metrics.overruled_frames = 7;
  metrics.overruled_share = 0.125;
  metrics.tracks = 3;
  return metrics;
}

TEST(Metrics, JsonHasExactlyDocumentedKeys) {
  EXPECT_EQ(to_json(sample()), R"({
  "frames": 120,
  "frames_skipped": 2,
  "hz": 12.5,
  "ms_per_frame": {
    "mean": 80.0,
    "p50": 79.0,
    "p99": 110.0
  },
  "stages": {
    "segmentation": {
      "mean": 40.0,
      "p50": 39.0,
      "p99": 60.0
    },
    "fusion": {
      "mean": 10.0,
      "p50": 9.0,
      "p99": 20.0
    }
  },
  "peak_rss_mb": 256.0,
  "status": {
    "initialized": 1,
    "tracking": 119,
    "degenerate": 0,
    "lost": 0,
    "recovered": 0
  },
  "dynamic_share": 0.25,
  "implausible_masks": 5,
  "overruled_frames": 7,
  "overruled_share": 0.125,
  "tracks": 3
}
)");
}

TEST(Metrics, GroundTruthAddsTrajectoryAndDrift) {
  RunMetrics metrics = sample();
  metrics.trajectory = TrajectoryError{.matched = 5, .poses = 6};
  metrics.drift = Drift{6, 1.0, 2.0};
  const std::string json = to_json(metrics);
  EXPECT_NE(json.find("\"trajectory\": {\n    \"matched\": 5"), std::string::npos) << json;
  EXPECT_NE(json.find("\"drift\": {\n    \"poses\": 6"), std::string::npos) << json;
  EXPECT_EQ(metric_values(metrics).size(), metric_values(sample()).size() + 10);
  metrics.stood_still = false;  // the distance from the start is no error
  EXPECT_EQ(metric_values(metrics).size(), metric_values(sample()).size() + 8);
}

TEST(Metrics, GroundTruthMapAddsMapError) {
  RunMetrics metrics = sample();
  metrics.map = MapError{.SA = 99.0, .DA = 50.0, .AA = 70.4, .HA = 66.4};
  const std::string json = to_json(metrics);
  EXPECT_NE(json.find("\"map\": {\n    \"SA\": 99.0"), std::string::npos) << json;
  EXPECT_NE(json.find("\"HA\": 66.4"), std::string::npos) << json;
  EXPECT_EQ(metric_values(metrics).size(), metric_values(sample()).size() + 3);
}

TEST(Metrics, EscapesStageNames) {
  RunMetrics metrics = sample();
  metrics.stages = {{"a \"b\"", {}}};
  EXPECT_NE(to_json(metrics).find(R"("a \"b\"")"), std::string::npos);
}

TEST(Metrics, TimeStatisticsUseNearestRank) {
  std::vector<double> times(200, 10.0);
  times[7] = 50.0;
  times[8] = 60.0;
  times[9] = 70.0;
  const TimeStatistics statistics = time_statistics(times);
  EXPECT_NEAR(statistics.mean, (197 * 10.0 + 180.0) / 200, 1e-12);
  EXPECT_EQ(statistics.p50, 10.0);
  EXPECT_EQ(statistics.p99, 50.0);
}

TEST(Metrics, AreNullWithoutFrames) {
  RunMetrics metrics;
  metrics.ms_per_frame = time_statistics({});
  EXPECT_NE(to_json(metrics).find("\"mean\": null"), std::string::npos);
}

TEST(Metrics, WritesFile) {
  const auto path = std::filesystem::temp_directory_path() / "mms_metrics_test.json";
  write_metrics(path, sample());
  std::ifstream file(path);
  const std::string content(std::istreambuf_iterator<char>(file), {});
  std::filesystem::remove(path);
  EXPECT_EQ(content, to_json(sample()));
}

}  // namespace
}  // namespace mms
