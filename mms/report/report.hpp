#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/evaluation/scores/metric_value.hpp"
#include "mms/report/view_axes.hpp"

namespace mms {

/// One frame of a run for the report's plots.
struct ReportFrame {
  Timestamp stamp;
  Transform<World, Sensor> T_world_sensor;
  /// In the world frame of the ground truth [m]; the report aligns it to the estimate.
  std::optional<Eigen::Vector3d> truth_position;
  Status status = Status::kInitialized;
  double dynamic_share = 0.0;    ///< of the valid points, in [0, 1]
  std::vector<double> stage_ms;  ///< parallel to RunReport::stages [ms]
};

/// What loops of a run changed. Empty without any.
struct ReportLoops {
  std::vector<Eigen::Vector3d> odometry;  ///< positions before the correction, by frame [m]
  std::vector<std::pair<std::size_t, std::size_t>> closed;     ///< frames of the accepted ones
  std::int64_t to_earlier_map = 0;                             ///< number of accepted ones
  std::vector<std::pair<std::string, std::int64_t>> rejected;  ///< their number by reason
};

struct ReportPicture {
  std::string title;
  Image<Rgb> image;
};

/// Data for a run's report. Any part may be empty; NaN makes gaps in the plots.
struct RunReport {
  std::string name;
  UpAxis up = UpAxis::kNegativeY;
  std::vector<std::string> stages;  ///< names in pipeline order
  std::vector<ReportFrame> frames;  ///< in order of time
  ReportLoops loops;
  std::vector<MetricSection> summary;
  std::string version;                ///< of the program
  std::vector<std::string> settings;  ///< those that differ from the defaults
  std::vector<std::string> warnings;
  Image<Rgb> map_view;      ///< top view of the static map (draw_map)
  Image<Rgb> objects_view;  ///< the same with tracked objects
  std::vector<ReportPicture> pictures;
};

/// The report as one self-contained HTML page: inline style, plots (SVG) and images, no scripts;
/// light or dark as the reader's system. Plots of long recordings are downsampled.
std::string report_html(const RunReport& report);

/// Writes `report_html` to a file atomically.
/// @throws FileError
void write_report_html(const std::filesystem::path& path, const RunReport& report);

}  // namespace mms
