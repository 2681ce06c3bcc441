#include "mms/evaluation/metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace mms {
namespace {

RunMetrics sample() {
  RunMetrics metrics;
  metrics.frames = 120;
  metrics.frames_skipped = 2;
  metrics.rate_hz = 12.5;
  metrics.ms_per_frame = {80.0, 79.0, 110.0};
  metrics.stages = {{"segmentation", {40.0, 39.0, 60.0}}, {"fusion", {10.0, 9.0, 20.0}}};
  metrics.peak_memory_mb = 256.0;
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
  "version": 2,
  "frames": 120,
  "frames_skipped": 2,
  "rate_hz": 12.5,
  "time_per_frame_s": {
    "mean": 0.08,
    "p50": 0.079,
    "p99": 0.11
  },
  "stages_s": {
    "segmentation": {
      "mean": 0.04,
      "p50": 0.039,
      "p99": 0.06
    },
    "fusion": {
      "mean": 0.01,
      "p50": 0.009000000000000001,
      "p99": 0.02
    }
  },
  "peak_memory_mb": 256.0,
  "status": {
    "initialized": 1,
    "tracking": 119,
    "degenerate": 0,
    "lost": 0,
    "recovered": 0
  },
  "dynamic_pct": 25.0,
  "implausible_masks": 5,
  "overruled_frames": 7,
  "overruled_pct": 12.5,
  "tracks": 3
}
)");
}

/// The section of that title; empty if there is none.
MetricSection section_of(const RunMetrics& metrics, const std::string& title) {
  for (MetricSection& section : metric_sections(metrics)) {
    if (section.title == title) return section;
  }
  return {};
}

bool has(const MetricSection& section, const std::string& key) {
  return std::any_of(section.values.begin(), section.values.end(),
                     [&](const MetricValue& item) { return item.key == key; });
}

TEST(Metrics, GroundTruthAddsTrajectoryAndDrift) {
  RunMetrics metrics = sample();
  metrics.trajectory = TrajectoryError{.matched = 5, .poses = 6};
  metrics.drift = Drift{6, 0.01, 0.02};
  const std::string json = to_json(metrics);
  EXPECT_NE(json.find("\"trajectory\": {\n    \"matched\": 5"), std::string::npos) << json;
  EXPECT_NE(json.find("\"drift\": {\n    \"poses\": 6"), std::string::npos) << json;
  EXPECT_TRUE(has(section_of(metrics, "Trajectory"), "ate_rmse_m"));
  EXPECT_TRUE(has(section_of(metrics, "Trajectory"), "atde_m"));
  metrics.stood_still = false;  // the distance from the start is no error
  EXPECT_FALSE(has(section_of(metrics, "Trajectory"), "atde_m"));
}

TEST(Metrics, TrajectoryOfLostFramesIsPoor) {
  RunMetrics metrics = sample();
  metrics.trajectory = TrajectoryError{.matched = 120, .poses = 120};
  EXPECT_EQ(section_of(metrics, "Trajectory").rating, "good");
  metrics.status[static_cast<std::size_t>(Status::kTracking)] = 40;
  metrics.status[static_cast<std::size_t>(Status::kLost)] = 79;
  EXPECT_EQ(section_of(metrics, "Trajectory").rating, "poor");
}

TEST(Metrics, GroundTruthMapAddsMapError) {
  RunMetrics metrics = sample();
  metrics.map = MapError{.SA = 99.0, .DA = 50.0, .AA = 70.4, .HA = 66.4};
  const std::string json = to_json(metrics);
  EXPECT_NE(json.find("\"map\": {\n    \"sa_pct\": 99.0"), std::string::npos) << json;
  EXPECT_NE(json.find("\"ha_pct\": 66.4"), std::string::npos) << json;
  EXPECT_EQ(section_of(metrics, "Map").values.size(), 3);
  EXPECT_EQ(section_of(metrics, "Map").rating, "poor");
}

TEST(Metrics, SectionsHaveNoRatingWithoutGroundTruth) {
  const auto sections = metric_sections(sample());
  EXPECT_EQ(sections.size(), 4);  // no map
  for (const MetricSection& section : sections) {
    EXPECT_EQ(section.rating, "") << section.title;
    for (const MetricValue& item : section.values) EXPECT_TRUE(std::isfinite(item.value));
  }
}

TEST(Metrics, RatesTrajectoryByItsLength) {
  RunMetrics metrics = sample();
  metrics.trajectory = TrajectoryError{.matched = 5, .poses = 5, .path_m = 1.0};
  const auto rating = [&](double path, double error) {
    metrics.trajectory->path_m = path;
    metrics.trajectory->ate_rmse_m = error;
    return section_of(metrics, "Trajectory").rating;
  };
  EXPECT_EQ(rating(0.0, 0.019), "good");
  EXPECT_EQ(rating(0.0, 0.03), "fair");
  EXPECT_EQ(rating(0.0, 0.11), "poor");
  EXPECT_EQ(rating(1000.0, 5.0), "good");
  EXPECT_EQ(rating(1000.0, 25.0), "poor");
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
