#include "mms/global_map/keyframes/scan_view.hpp"

#include <cstddef>
#include <utility>

#include "mms/mapping/free_space/cube_pixel.hpp"
#include "mms/mapping/free_space/scan_free_space.hpp"

namespace mms {
namespace {

/// [px]: side of a face of 90 degrees. Source: that of `ScanFreeSpace`, which compares the views.
constexpr int kViewSide = 90;

/// [m]: distance before a surface, noise included, that contradicts it. Source: as for depth images
/// (0.1 m) above five sigma of a LiDAR's 2 cm.
constexpr double kScanMargin = 0.2;

/// The nearest and the farthest point in a direction, as 1 + its index; 0 for none.
struct Extremes {
  std::size_t nearest = 0;
  std::size_t farthest = 0;
};

}  // namespace

ScanView make_scan_view(const LabeledCloud& cloud) {
  CubeImage<Extremes> faces = make_cube<Extremes>(kViewSide);
  const auto range = [&](std::size_t one_more) { return cloud.points[one_more - 1].norm(); };
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float distance = cloud.points[i].norm();
    if (cloud.labels[i] == PointLabel::kInvalid || !has_direction(distance)) continue;
    const CubePixel pixel(cloud.points[i], kViewSide);
    Extremes& extremes = faces[pixel.face](pixel.x, pixel.y);
    if (extremes.nearest == 0 || distance < range(extremes.nearest)) extremes.nearest = i + 1;
    if (extremes.farthest == 0 || distance > range(extremes.farthest)) extremes.farthest = i + 1;
  }
  ScanView view;
  const auto add = [&](std::size_t one_more) {
    view.points.push_back(cloud.points[one_more - 1]);
    view.is_static.push_back(cloud.labels[one_more - 1] == PointLabel::kStatic ? 1 : 0);
  };
  for (const Image<Extremes>& face : faces) {
    for (const Extremes& extremes : face.pixels()) {
      if (extremes.nearest == 0) continue;
      add(extremes.nearest);
      if (extremes.farthest != extremes.nearest) add(extremes.farthest);
    }
  }
  return view;
}

LabeledCloud ScanView::cloud() const {
  LabeledCloud cloud;
  cloud.width = static_cast<int>(points.size());
  cloud.height = 1;
  cloud.points = points;
  for (const std::uint8_t value : is_static) {
    cloud.labels.push_back(value != 0 ? PointLabel::kStatic : PointLabel::kDynamic);
  }
  return cloud;
}

ViewAgreement compare_scans(const ScanView& a, const ScanView& b, const Eigen::Isometry3d& T_a_b) {
  const ScanFreeSpace space(a.cloud(), kScanMargin);
  const Eigen::Isometry3f T = T_a_b.cast<float>();
  std::size_t all = 0;
  std::size_t on_surface = 0;
  std::size_t in_free_space = 0;
  for (std::size_t i = 0; i < b.points.size(); ++i) {
    if (b.is_static[i] == 0) continue;
    ++all;
    const SpaceState state = space.state_at(T * b.points[i]);
    on_surface += state == SpaceState::kSurface;
    in_free_space += state == SpaceState::kFree;
  }
  return agreement_of(all, on_surface, in_free_space);
}

}  // namespace mms
