#include "mms/report/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "mms/core/error.hpp"

namespace mms {
namespace {

RunReport sample(int frames) {
  RunReport report;
  report.name = "warehouse <1> & \"2\"";
  report.stages = {"segmentation", "fusion", "odometry<b>"};
  report.summary = {{"Speed", "", {{"", "rate", 12.34, "Hz", 1}}},
                    {"<i>odd</i>", "good", {{"", "<i>odd</i>", std::nan(""), "m", 3}}}};
  for (int i = 0; i < frames; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / std::max(frames, 2);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(2.0 * std::cos(angle), 0.0, std::sin(angle));
    ReportFrame frame;
    frame.stamp = Timestamp(i * 66'666'667LL);
    frame.T_world_sensor = Transform<World, Sensor>(pose);
    frame.truth_position = pose.translation() + Eigen::Vector3d(100.0, 5.0, -30.0);
    frame.status = i == 0 ? Status::kInitialized : Status::kTracking;
    frame.dynamic_share = 0.2;
    frame.stage_ms = {30.0, 10.0, 20.0};
    report.frames.push_back(frame);
  }
  return report;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Report, HasEverySection) {
  RunReport report = sample(20);
  report.map_view = Image<Rgb>(8, 6, Rgb{10, 20, 30});
  report.pictures = {{"frame 7", Image<Rgb>(4, 4)}};
  const std::string html = report_html(report);
  for (const char* part :
       {"<!DOCTYPE html>", "12.3 Hz", "20 frames", "Trajectory, top view", "ground truth, aligned",
        "Position error against the aligned ground truth", "Time per stage", "whole frame",
        "Dynamic share", "tracking: 19", "initialized: 1", "data:image/png;base64,iVBOR",
        "data:image/jpeg;base64,/9j/", "frame 7", "</html>"}) {
    EXPECT_TRUE(contains(html, part)) << part;
  }
}

TEST(Report, ShowsWhatLoopsChanged) {
  RunReport report = sample(20);
  EXPECT_FALSE(contains(report_html(report), "odometry</span>"));
  report.loops.odometry.assign(20, Eigen::Vector3d::Zero());
  report.loops.closed = {{0, 19}, {1, 18}};
  report.loops.rejected = {{"few inliers", 7}, {"unlikely", 1}};
  const std::string html = report_html(report);
  for (const char* part :
       {"2 loops. Rejected: 7 few inliers, 1 unlikely.", "odometry</span>", "loops</span>"}) {
    EXPECT_TRUE(contains(html, part)) << part;
  }
}

TEST(Report, NamesVersionSettingsAndWarnings) {
  RunReport report = sample(5);
  EXPECT_FALSE(contains(report_html(report), "<h2>Run</h2>"));
  report.version = "1.2.3";
  EXPECT_TRUE(contains(report_html(report), "All settings have their defaults."));
  report.settings = {"static_map.voxel_size: 0.07"};
  report.warnings = {"frame <1> skipped"};
  const std::string html = report_html(report);
  for (const char* part :
       {"mms 1.2.3", "<li>static_map.voxel_size: 0.07</li>", "<li>frame &lt;1&gt; skipped</li>"}) {
    EXPECT_TRUE(contains(html, part)) << part;
  }
}

TEST(Report, HasNoExternalReferences) {
  const std::string html = report_html(sample(20));
  for (const char* part : {"http", "<script", "<link", "@import", "url("}) {
    EXPECT_FALSE(contains(html, part)) << part;
  }
}

TEST(Report, EscapesEveryText) {
  RunReport report = sample(5);
  report.pictures = {{"<u>\"title\"", Image<Rgb>(4, 4)}};
  const std::string html = report_html(report);
  for (const char* raw : {"<1>", "<i>odd", "odometry<b>", "<u>", "alt=\"<", "\"title\""}) {
    EXPECT_FALSE(contains(html, raw)) << raw;
  }
  EXPECT_TRUE(contains(html, "warehouse &lt;1&gt; &amp; &quot;2&quot;"));
}

TEST(Report, AlignsGroundTruthOfOtherWorld) {
  // The truth is the estimate in another world, so the aligned curves coincide.
  const std::string html = report_html(sample(20));
  const auto path = [&](std::size_t from) {
    const auto begin = html.find("d=\"M", html.find("class=\"line", from));
    return html.substr(begin, html.find("\"/>", begin) - begin);
  };
  const auto first = html.find("class=\"line");
  EXPECT_EQ(path(first), path(first + 5));
}

TEST(Report, ShowsDistanceFromFirstPoseWithoutTruth) {
  RunReport report = sample(20);
  for (ReportFrame& frame : report.frames) frame.truth_position.reset();
  const std::string html = report_html(report);
  EXPECT_TRUE(contains(html, "Distance from the first pose"));
  EXPECT_FALSE(contains(html, "ground truth, aligned"));
}

TEST(Report, HandlesRunWithoutFrames) {
  const std::string html = report_html({});
  EXPECT_TRUE(contains(html, "no frames were processed"));
  EXPECT_TRUE(contains(html, "</html>"));
}

TEST(Report, HandlesSingleFrame) {
  EXPECT_TRUE(contains(report_html(sample(1)), "1 frame over"));
}

TEST(Report, HandlesNonFiniteNumbers) {
  RunReport report = sample(10);
  Eigen::Isometry3d invalid = Eigen::Isometry3d::Identity();
  invalid.translation().setConstant(std::nan(""));
  for (const std::size_t i : {0U, 4U, 5U}) {
    report.frames[i].T_world_sensor = Transform<World, Sensor>(invalid);
  }
  report.frames[2].stage_ms = {std::nan("")};
  report.frames[3].stage_ms.clear();
  report.frames[3].dynamic_share = INFINITY;
  report.frames[6].truth_position = Eigen::Vector3d::Constant(INFINITY);
  const std::string html = report_html(report);
  EXPECT_FALSE(contains(html, "nan"));
  EXPECT_FALSE(contains(html, "inf,"));
}

TEST(Report, StaysSmallForTenThousandFrames) {
  EXPECT_LT(report_html(sample(10'000)).size(), 400'000U);
}

TEST(Report, WritesFile) {
  const auto path = std::filesystem::temp_directory_path() / "mms_report_test.html";
  write_report_html(path, sample(3));
  std::ifstream file(path);
  const std::string content(std::istreambuf_iterator<char>(file), {});
  std::filesystem::remove(path);
  EXPECT_EQ(content, report_html(sample(3)));
  EXPECT_THROW(write_report_html("/nonexistent/folder/report.html", sample(3)), FileError);
}

TEST(Report, ManyLoopsStayLinesOfTheirOwn) {
  RunReport report = sample(1000);
  report.loops.odometry.assign(1000, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < 900; ++i) report.loops.closed.emplace_back(i, i + 100);
  const std::string html = report_html(report);
  const std::size_t begin = html.find("class=\"line c3\"");
  const std::string line = html.substr(begin, html.find("/>", begin) - begin);
  const auto moves = std::count(line.begin(), line.end(), 'M');
  EXPECT_GE(moves, 300);
  EXPECT_EQ(moves, std::count(line.begin(), line.end(), 'L'));
}

}  // namespace
}  // namespace mms
