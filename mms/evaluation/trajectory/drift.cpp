#include "mms/evaluation/trajectory/drift.hpp"

#include <string>

#include "mms/core/error.hpp"
#include "mms/evaluation/scores/statistics.hpp"

namespace mms {

Drift evaluate_drift(const Trajectory& estimate) {
  constexpr double kCentimetersPerMeter = 100.0;
  Trajectory finite;
  for (const StampedPose& pose : estimate) {
    if (pose.T_world_sensor.is_finite()) finite.push_back(pose);
  }
  if (finite.empty()) {
    throw DataError("drift", "none of " + std::to_string(estimate.size()) + " poses is finite",
                    "expected at least 1");
  }
  const Eigen::Vector3d origin = finite.front().T_world_sensor.translation();
  std::vector<double> distances;
  for (const StampedPose& pose : finite) {
    const double meters = (pose.T_world_sensor.translation() - origin).norm();
    distances.push_back(kCentimetersPerMeter * meters);
  }
  return {finite.size(), mean(distances), maximum(distances)};
}

std::vector<MetricValue> metric_values(const Drift& drift) {
  return {{"poses", "poses", static_cast<double>(drift.poses), "", 0},
          {"atde_cm", "ATDE (mean drift)", drift.atde_cm, "cm", 3},
          {"mtde_cm", "MTDE (largest drift)", drift.mtde_cm, "cm", 3}};
}

}  // namespace mms
