#include "mms/localization/photometric/reference_keyframes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mms/geometry/se3.hpp"

namespace mms {

double ReferenceKeyframes::distance(const IntensityKeyframe& keyframe,
                                    const Eigen::Isometry3d& pose) const {
  const Eigen::Isometry3d between = keyframe.T_world_sensor.inverse() * pose;
  const double threshold =
      std::max(config_.keyframe_translation, config_.keyframe_parallax * keyframe.depth);
  constexpr double kDegree = M_PI / 180.0;
  return std::hypot(between.translation().norm() / threshold,
                    se3::angle(between) / (config_.keyframe_rotation * kDegree));
}

std::vector<const IntensityKeyframe*> ReferenceKeyframes::nearest(
    const Eigen::Isometry3d& T_world_sensor) const {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    order.emplace_back(distance(keyframes_[i], T_world_sensor), i);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), static_cast<std::size_t>(config_.references)));
  std::vector<const IntensityKeyframe*> result;
  for (const auto& [unused, index] : order) result.push_back(&keyframes_[index]);
  return result;
}

void ReferenceKeyframes::update(const std::vector<IntensityLevel>& levels,
                                const Eigen::Isometry3d& T_world_sensor) {
  if (levels.empty() || !config_.enabled) return;
  const auto from_here = [&](const IntensityKeyframe& keyframe) {
    return distance(keyframe, T_world_sensor);
  };
  const bool known = std::any_of(keyframes_.begin(), keyframes_.end(),
                                 [&](const auto& keyframe) { return from_here(keyframe) < 1.0; });
  if (known) return;
  if (keyframes_.size() >= static_cast<std::size_t>(config_.max_keyframes)) {
    keyframes_.erase(std::max_element(
        keyframes_.begin(), keyframes_.end(),
        [&](const auto& a, const auto& b) { return from_here(a) < from_here(b); }));
  }
  keyframes_.push_back(make_intensity_keyframe(levels, T_world_sensor, config_, noise_));
}

}  // namespace mms
