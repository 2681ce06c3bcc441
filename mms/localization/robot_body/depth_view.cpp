#include "mms/localization/robot_body/depth_view.hpp"

#include <cmath>
#include <cstdlib>

namespace mms {
namespace {

/// [-]: sigmas of the difference of two depths within which they agree. Source: three-sigma rule,
/// of two measurements.
constexpr float kSigmas = 4.24F;

/// [m]: further difference of the depth at one pixel. Source: initial choice; vibrations of the
/// robot.
constexpr float kConstantMargin = 0.01F;

/// [m]: further difference of the depth in one direction. Source: initial choice; inclined surfaces
/// between pixels.
constexpr float kMargin = 0.03F;

/// [grey levels]: difference of the brightness of one surface. Source: initial choice; noise and
/// automatic exposure.
constexpr int kMaxGreyChange = 20;

std::uint8_t grey_of(const Rgb& color) {
  return static_cast<std::uint8_t>((color.r + 2 * color.g + color.b) / 4);
}

}  // namespace

DepthView::DepthView(const LabeledCloud& cloud, const DepthNoise& noise)
    : camera_(cloud.camera),
      noise_(noise),
      depth_(cloud.width, cloud.height),
      nodes_(cloud.width / kNodeStep, cloud.height / kNodeStep) {
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    if (cloud.labels[i] == PointLabel::kStatic) depth_[i] = cloud.points[i].z();
  }
  for (int y = 0; y < nodes_.height(); ++y) {
    for (int x = 0; x < nodes_.width(); ++x) {
      const int u = kNodeStep * x + kNodeStep / 2;
      const int v = kNodeStep * y + kNodeStep / 2;
      const std::size_t i = cloud.index(u, v);
      nodes_(x, y).is_masked = cloud.labels[i] == PointLabel::kDynamic;
      if (depth_(u, v) <= 0.0F) continue;
      nodes_(x, y).point = cloud.points[i];
      if (!cloud.colors.empty()) nodes_(x, y).grey = grey_of(cloud.colors[i]);
      ++valid_nodes_;
    }
  }
}

DepthView::Seen DepthView::at(const Eigen::Vector3f& point,
                              const Image<std::uint8_t>& hidden) const {
  const Eigen::Vector3d p = point.cast<double>();
  if (!(p.z() > 0.0) || !camera_.in_lens_range(p)) return Seen::kNothing;
  const Eigen::Vector2d pixel = camera_.project(p);
  const auto u = static_cast<int>(std::lround(pixel.x()));
  const auto v = static_cast<int>(std::lround(pixel.y()));
  if (!depth_.contains(u, v) || depth_(u, v) <= 0.0F) return Seen::kNothing;
  const int x = u / kNodeStep;
  const int y = v / kNodeStep;
  if (hidden.contains(x, y) && hidden(x, y) != 0) return Seen::kNothing;
  const float limit = kMargin + kSigmas * noise_.sigma(point.z());
  return std::abs(depth_(u, v) - point.z()) < limit ? Seen::kSame : Seen::kOther;
}

bool DepthView::has_changed(int x, int y, const DepthView& other) const {
  const Node& here = nodes_(x, y);
  const Node& there = other.nodes_(x, y);
  if (!here.is_valid() || !there.is_valid()) return false;
  const float limit = kConstantMargin + kSigmas * noise_.sigma(here.point.z());
  return std::abs(here.point.z() - there.point.z()) >= limit ||
         std::abs(here.grey - there.grey) > kMaxGreyChange;
}

}  // namespace mms
