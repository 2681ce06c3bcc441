#include "mms/mapping/motion_segmentation/place_views.hpp"

#include <algorithm>
#include <cstddef>

#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

/// [-]: views that are kept. Source: memory, 20 MB at 320 x 240 points.
constexpr std::size_t kMaxViews = 64;

/// [m]: distance between the views of two places. Source: initial choice; a few overlap then.
constexpr double kPlaceSpacing = 0.5;

/// [rad]: the same of the angle. Source: a third of the angle of view of a Kinect.
constexpr double kAngleSpacing = 0.35;

/// [m]: distance up to which a view is asked. Source: twice the spacing, so that two are in reach.
constexpr double kPlaceReach = 1.0;

/// [rad]: the same of the angle. Source: as `kPlaceReach`.
constexpr double kPlaceAngleReach = 0.7;

/// [-]: views that are asked. Source: computing time.
constexpr std::size_t kAsked = 3;

/// [-]: of them that must have a surface at a point. Source: one may be of an object in motion.
constexpr int kAgreeing = 2;

/// Distance of two poses in units of one view's reach; above 1 beyond it.
double distance(const Transform<World, Sensor>& a, const Transform<World, Sensor>& b, double reach,
                double angle_reach) {
  const Eigen::Isometry3d difference = (a.inverse() * b).isometry();
  return std::max(difference.translation().norm() / reach, se3::angle(difference) / angle_reach);
}

}  // namespace

void PlaceViews::add(Timestamp stamp, const FreeSpace& statics,
                     const Transform<World, Sensor>& T_world_sensor) {
  const bool is_known = std::any_of(views_.begin(), views_.end(), [&](const View& view) {
    return distance(view.T_world_sensor, T_world_sensor, kPlaceSpacing, kAngleSpacing) < 1.0;
  });
  if (is_known) return;
  if (views_.size() == kMaxViews) views_.pop_front();
  views_.push_back({stamp, statics, T_world_sensor});
}

PlaceViews::Query PlaceViews::query(Timestamp now, double min_age,
                                    const Transform<World, Sensor>& T_world_sensor) const {
  std::vector<std::pair<double, const View*>> near;
  for (const View& view : views_) {
    const double there =
        distance(view.T_world_sensor, T_world_sensor, kPlaceReach, kPlaceAngleReach);
    if (to_seconds(now - view.stamp) > min_age && there < 1.0) near.emplace_back(there, &view);
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  Query query;
  for (std::size_t i = 0; i < std::min(near.size(), kAsked); ++i) {
    const View& view = *near[i].second;
    query.views_.emplace_back(
        &view.statics, (view.T_world_sensor.inverse() * T_world_sensor).isometry().cast<float>());
  }
  return query;
}

bool PlaceViews::Query::is_on_surface(const Eigen::Vector3f& point) const {
  int agreeing = 0;
  for (const auto& [statics, T_view_sensor] : views_) {
    agreeing += statics->state_at(T_view_sensor * point) == SpaceState::kSurface ? 1 : 0;
  }
  return agreeing >= kAgreeing;
}

}  // namespace mms
