#include "mms/run/view/run_series.hpp"

#include <limits>

#include "mms/pipeline/frame_result.hpp"

namespace mms {

std::vector<SeriesName> run_series(bool has_truth) {
  std::vector<SeriesName> series = {{"read", "ms"}};
  for (std::size_t i = 0; i < kStageCount; ++i) {
    series.push_back({std::string(to_string(static_cast<Stage>(i))), "ms"});
  }
  series.push_back({"interval", "ms"});
  series.push_back({"dynamic_share", "ratio"});
  series.push_back({"overruled_share", "ratio"});
  series.push_back({"objects", "count"});
  series.push_back({"drift_cm", "cm"});
  if (has_truth) series.push_back({"error_cm", "cm"});
  return series;
}

void append_distances(std::vector<float>& values, const SceneFrame& frame, bool has_truth) {
  constexpr double kCentimetres = 100.0;
  const Eigen::Vector3d position = frame.T_world_sensor.translation();
  values.push_back(static_cast<float>(kCentimetres * position.norm()));
  if (!has_truth) return;
  values.push_back(frame.truth ? static_cast<float>(kCentimetres * (position - *frame.truth).norm())
                               : std::numeric_limits<float>::quiet_NaN());
}

}  // namespace mms
