#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/evaluation/scores/metric_value.hpp"
#include "mms/report/view_axes.hpp"

namespace mms {

/// One frame of a run, as the report's plots show it.
struct ReportFrame {
  Timestamp stamp;
  Transform<World, Sensor> T_world_sensor;
  /// In the truth's own world frame [m]; the report aligns it to the estimate.
  std::optional<Eigen::Vector3d> truth_position;
  Status status = Status::kInitialized;
  double dynamic_share = 0.0;    ///< of the valid points, in [0, 1]
  std::vector<double> stage_ms;  ///< parallel to RunReport::stages [ms]
};

struct ReportPicture {
  std::string title;
  Image<Rgb> image;
};

/// Everything a run's report shows. Any part may be empty; NaN leaves gaps in the plots.
struct RunReport {
  std::string name;
  UpAxis up = UpAxis::kNegativeY;
  std::vector<std::string> stages;  ///< names, in the order of the pipeline
  std::vector<ReportFrame> frames;  ///< in the order of time
  std::vector<MetricValue> summary;
  Image<Rgb> map_view;      ///< static map from above (draw_map)
  Image<Rgb> objects_view;  ///< the same with the tracked objects in it
  std::vector<ReportPicture> pictures;
};

/// The report as one HTML page that needs nothing else: style, plots (SVG) and pictures inline, no
/// scripts; light or dark as the reader's system is. Recordings of any length: plots are thinned.
std::string report_html(const RunReport& report);

/// Writes `report_html` to a file, whole or not at all. @throws FileError
void write_report_html(const std::filesystem::path& path, const RunReport& report);

}  // namespace mms
