#include "mms/report/report_plots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "mms/evaluation/scores/statistics.hpp"
#include "mms/evaluation/trajectory/alignment.hpp"
#include "mms/report/svg_plot.hpp"

namespace mms {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kEstimateColor = 0;
constexpr int kTruthColor = 1;
constexpr int kStartColor = 2;
constexpr int kOdometryColor = 4;
constexpr int kLoopColor = 3;
/// Largest number of values per stage.
constexpr std::size_t kMaxRuns = 400;
/// Largest number of loops: lines of more than 2000 values are downsampled, and lose gaps.
constexpr std::size_t kMaxLoops = 600;

using Values = std::vector<double>;
using Positions = std::vector<Eigen::Vector3d>;

Eigen::Vector3d position(const ReportFrame& frame) {
  return frame.T_world_sensor.translation();
}

bool has_truth(const ReportFrame& frame) {
  return frame.truth_position && frame.truth_position->allFinite() && position(frame).allFinite();
}

/// Ground truth in the frame of the estimate, NaN for frames without; empty for fewer than three
/// frames with ground truth, too few to align.
Positions aligned_truth(const RunReport& report) {
  Positions truth;
  Positions estimate;
  for (const ReportFrame& frame : report.frames) {
    if (!has_truth(frame)) continue;
    truth.push_back(*frame.truth_position);
    estimate.push_back(position(frame));
  }
  if (truth.size() < 3) return {};
  const Eigen::Isometry3d T_world_truth = align_points(truth, estimate);
  Positions aligned;
  for (const ReportFrame& frame : report.frames) {
    aligned.push_back(has_truth(frame) ? T_world_truth * *frame.truth_position
                                       : Eigen::Vector3d::Constant(kNaN));
  }
  return aligned;
}

/// Since the first frame [s].
Values seconds(const RunReport& report) {
  Values times;
  for (const ReportFrame& frame : report.frames) {
    times.push_back(to_seconds(frame.stamp - report.frames.front().stamp));
  }
  return times;
}

Positions estimated(const RunReport& report) {
  Positions positions;
  for (const ReportFrame& frame : report.frames) positions.push_back(position(frame));
  return positions;
}

void add_path(SvgPlot& plot, const std::string& name, int color, const Positions& positions,
              const ViewAxes& axes) {
  Values x;
  Values y;
  for (const Eigen::Vector3d& point : positions) {
    x.push_back(axes.right.dot(point));
    y.push_back(axes.up.dot(point));
  }
  plot.add_line(name, color, x, y);
}

/// Both ends of each loop, with gaps between them; of many loops some.
Positions loop_lines(const RunReport& report) {
  Positions lines;
  const auto& closed = report.loops.closed;
  for (std::size_t i = 0; i < closed.size(); i += closed.size() / kMaxLoops + 1) {
    const auto& [earlier, later] = closed[i];
    lines.push_back(position(report.frames[earlier]));
    lines.push_back(position(report.frames[later]));
    lines.emplace_back(Eigen::Vector3d::Constant(kNaN));
  }
  return lines;
}

/// First finite position, else NaN.
Eigen::Vector3d first_position(const RunReport& report) {
  for (const ReportFrame& frame : report.frames) {
    if (position(frame).allFinite()) return position(frame);
  }
  return Eigen::Vector3d::Constant(kNaN);
}

/// Distance to the aligned ground truth, or from the first pose if `truth` is empty [m].
Values distances(const RunReport& report, const Positions& truth) {
  const Eigen::Vector3d first = first_position(report);
  Values values;
  for (std::size_t i = 0; i < report.frames.size(); ++i) {
    values.push_back((position(report.frames[i]) - (truth.empty() ? first : truth[i])).norm());
  }
  return values;
}

double stage_time(const ReportFrame& frame, std::size_t stage) {
  const double time = stage < frame.stage_ms.size() ? frame.stage_ms[stage] : 0.0;
  return std::isfinite(time) ? time : 0.0;
}

/// Sum of a frame's stage times before stage `end` [ms].
double time_before(const ReportFrame& frame, std::size_t end) {
  double sum = 0.0;
  for (std::size_t stage = 0; stage < end; ++stage) sum += stage_time(frame, stage);
  return sum;
}

/// Applies `reduce` to at most kMaxRuns runs of consecutive values; extremes, as used for lines,
/// would make areas jagged.
Values reduced(const Values& values, double (*reduce)(std::span<const double>)) {
  const std::size_t run = (values.size() + kMaxRuns - 1) / kMaxRuns;
  Values result;
  for (std::size_t begin = 0; begin < values.size(); begin += run) {
    const std::size_t count = std::min(run, values.size() - begin);
    result.push_back(reduce(std::span(values).subspan(begin, count)));
  }
  return result;
}

Values accumulated(const RunReport& report, std::size_t end) {
  Values sums;
  for (const ReportFrame& frame : report.frames) sums.push_back(time_before(frame, end));
  return sums;
}

}  // namespace

/// [m]: so that a sensor at rest is a dot, though the errors of its poses are millimeters.
constexpr double kMinExtent = 0.2;

std::string trajectory_plot(const RunReport& report) {
  const bool camera = report.up == UpAxis::kNegativeY;
  SvgPlot plot({.title = "trajectory, top view",
                .x_label = "x [m]",
                .y_label = camera ? "z [m]" : "y [m]",
                .width = 520,
                .height = 400,
                .equal_aspect = true,
                .min_extent = kMinExtent});
  const ViewAxes axes = view_axes(Viewpoint::kTop, report.up);
  const Positions truth = aligned_truth(report);
  if (!truth.empty()) add_path(plot, "ground truth, aligned", kTruthColor, truth, axes);
  if (!report.loops.odometry.empty()) {
    add_path(plot, "odometry", kOdometryColor, report.loops.odometry, axes);
    add_path(plot, "loops", kLoopColor, loop_lines(report), axes);
  }
  add_path(plot, "estimate", kEstimateColor, estimated(report), axes);
  const Eigen::Vector3d start = first_position(report);
  plot.add_marker("start", kStartColor, axes.right.dot(start), axes.up.dot(start));
  return plot.render();
}

std::string error_plot_title(const RunReport& report) {
  return aligned_truth(report).empty() ? "Distance from the first pose"
                                       : "Position error against the aligned ground truth";
}

std::string error_plot(const RunReport& report) {
  const Positions truth = aligned_truth(report);
  Values values = distances(report, truth);
  const bool centimeters = maximum(values) < 1.0;
  if (centimeters) std::for_each(values.begin(), values.end(), [](double& v) { v *= 100.0; });
  SvgPlot plot({.title = error_plot_title(report),
                .x_label = "time [s]",
                .y_label = centimeters ? "[cm]" : "[m]",
                .height = 220,
                .y_from_zero = true});
  plot.add_line(truth.empty() ? "distance" : "error", kEstimateColor, seconds(report), values);
  return plot.render();
}

std::string stage_plot(const RunReport& report) {
  SvgPlot plot(
      {.title = "time per stage", .x_label = "time [s]", .y_label = "[ms]", .y_from_zero = true});
  const Values times = seconds(report);
  const Values run_times = reduced(times, mean);
  for (std::size_t stage = 0; stage < report.stages.size(); ++stage) {
    plot.add_band(report.stages[stage], static_cast<int>(stage), run_times,
                  reduced(accumulated(report, stage), mean),
                  reduced(accumulated(report, stage + 1), mean));
  }
  constexpr int kTotalColor = 7;
  const bool thinned = times.size() > kMaxRuns;
  plot.add_line(thinned ? "whole frame, slowest" : "whole frame", kTotalColor, run_times,
                reduced(accumulated(report, report.stages.size()), maximum));
  return plot.render();
}

std::string share_plot(const RunReport& report) {
  SvgPlot plot({.title = "dynamic share",
                .x_label = "time [s]",
                .y_label = "[%]",
                .height = 180,
                .y_from_zero = true});
  Values shares;
  for (const ReportFrame& frame : report.frames) shares.push_back(100.0 * frame.dynamic_share);
  plot.add_line("dynamic points", 3, seconds(report), shares);
  return plot.render();
}

}  // namespace mms
