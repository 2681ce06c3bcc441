#include "mms/evaluation/trajectory/drift.hpp"

#include <string>

#include "mms/core/error.hpp"
#include "mms/evaluation/scores/statistics.hpp"

namespace mms {

Drift evaluate_drift(const Trajectory& estimate) {
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
    distances.push_back((pose.T_world_sensor.translation() - origin).norm());
  }
  return {finite.size(), mean(distances), maximum(distances)};
}

std::vector<MetricValue> metric_values(const Drift& drift) {
  return {{"poses", "poses", static_cast<double>(drift.poses), "", 0},
          {"atde_m", "ATDE (mean drift)", drift.atde_m, "m", 4},
          {"mtde_m", "MTDE (largest drift)", drift.mtde_m, "m", 4}};
}

}  // namespace mms
