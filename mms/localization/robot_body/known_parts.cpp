#include "mms/localization/robot_body/known_parts.hpp"

#include <algorithm>
#include <limits>

#include "mms/localization/features/feature_exclusion.hpp"
#include "mms/localization/robot_body/depth_view.hpp"

namespace mms {
namespace {

/// [frames]: in a row in which a node of a part shows what is behind it, so that it is none.
/// Source: initial choice; single ones are noise.
constexpr int kMaxMisses = 5;

/// [m]: depth behind a part up to which points belong to it. Source: initial choice; the robot's
/// vibrations and mixed pixels.
constexpr float kDepthMargin = 0.05F;

}  // namespace

void KnownParts::exclude(LabeledCloud& cloud, FeatureCloud& features) {
  const bool is_other_camera =
      parts_.width() != cloud.width / kNodeStep || parts_.height() != cloud.height / kNodeStep;
  if (parts_.empty() || !cloud.organised() || is_other_camera) return;
  forget_uncovered(cloud);
  Image<std::uint8_t> points(cloud.width, cloud.height);
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const int x = std::min(u / kNodeStep, limits_.width() - 1);
      const int y = std::min(v / kNodeStep, limits_.height() - 1);
      const std::size_t i = cloud.index(u, v);
      // Not so for NaN.
      if (!(cloud.points[i].z() <= limits_(x, y))) continue;
      cloud.labels[i] = PointLabel::kInvalid;
      cloud.points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
      if (!cloud.cluster.empty()) cloud.cluster[i] = -1;
      points[i] = 1;
    }
  }
  mms::exclude(points, cloud, features);
}

void KnownParts::forget_uncovered(const LabeledCloud& cloud) {
  bool are_any = false;
  for (int y = 0; y < parts_.height(); ++y) {
    for (int x = 0; x < parts_.width(); ++x) {
      if (parts_(x, y) <= 0.0F) continue;
      const int u = kNodeStep * x + kNodeStep / 2;
      const int v = kNodeStep * y + kNodeStep / 2;
      const float z = cloud.points[cloud.index(u, v)].z();
      misses_(x, y) = z > parts_(x, y) + kDepthMargin ? misses_(x, y) + 1 : 0;
      if (misses_(x, y) < kMaxMisses) continue;
      parts_(x, y) = 0.0F;
      are_any = true;
    }
  }
  if (are_any) set_limits();
}

double KnownParts::share() const {
  if (parts_.empty()) return 0.0;
  const auto nodes = std::count_if(parts_.pixels().begin(), parts_.pixels().end(),
                                   [](float depth) { return depth > 0.0F; });
  return static_cast<double>(nodes) / static_cast<double>(parts_.size());
}

void KnownParts::add(const DepthView& view, const Image<std::uint8_t>& nodes) {
  if (!parts_.same_size(nodes)) {
    parts_ = Image<float>(nodes.width(), nodes.height());
    misses_ = Image<std::uint8_t>(nodes.width(), nodes.height());
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] != 0) parts_[i] = view.nodes()[i].point.z();
  }
  set_limits();
}

/// The points around a node of a part are of the part, too, as far as they are not behind it.
void KnownParts::set_limits() {
  limits_ = Image<float>(parts_.width(), parts_.height());
  for (int y = 0; y < parts_.height(); ++y) {
    for (int x = 0; x < parts_.width(); ++x) {
      if (parts_(x, y) <= 0.0F) continue;
      for (int v = std::max(0, y - 1); v <= std::min(y + 1, parts_.height() - 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(x + 1, parts_.width() - 1); ++u) {
          limits_(u, v) = std::max(limits_(u, v), parts_(x, y) + kDepthMargin);
        }
      }
    }
  }
}

}  // namespace mms
