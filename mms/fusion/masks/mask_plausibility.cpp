#include "mms/fusion/masks/mask_plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mms/geometry/principal_axes.hpp"

namespace mms {
namespace {

/// [-]: cloud points per sample along either axis. Source: computing time.
constexpr int kStep = 4;

/// [-]: samples of a mask that can be judged. Source: initial choice; the box of
/// a person at 8 m has 57 in the image of a Kinect.
constexpr std::size_t kMinSamples = 40;

/// [-]: share of the samples cut off at either end of an axis. Source: initial choice; masks cover
/// some background beside and behind an object.
constexpr double kTrim = 0.15;

/// [-]: largest second extent, in lengths of the class. Source: initial choice; people side by side
/// under one mask are wider than that, but not taller.
constexpr double kMaxHeight = 1.2;

/// [m]: shorter side of a flat surface that is no person. Source: wider than a torso.
constexpr float kFlatWidth = 0.5F;

/// [m]: its longer side. Source: longer than a torso from neck to hip.
constexpr float kFlatLength = 0.8F;

/// [-]: share of the samples on it. Source: initial choice; of a standing person's front the torso
/// is flat, with head, arms and legs before and behind it.
constexpr double kFlatShare = 0.85;

/// [m]: tolerance of the plane, noise included, up to which a flat surface differs from a body.
/// Source: a third of a torso's radius of 0.17 m; a Kinect's noise reaches it at 3 m.
constexpr float kMaxTolerance = 0.06F;

/// [-]: rounds in which the plane is fitted again to the samples near it. Source: initial choice.
constexpr int kRounds = 3;

/// [-]: share of the samples nearest to the plane that it is fitted to. Source: as `kFlatShare`.
constexpr double kFitted = 0.8;

using Points = std::vector<Eigen::Vector3f>;

/// Points under each mask.
std::vector<Points> sample(const LabeledCloud& cloud, std::size_t instances,
                           const MaskImage& mask) {
  std::vector<Points> samples(instances);
  for (int y = 0; y < cloud.height; y += kStep) {
    for (int x = 0; x < cloud.width; x += kStep) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(cloud.width) +
                            static_cast<std::size_t>(x);
      if (mask.raw[i] == 0 || cloud.labels[i] == PointLabel::kInvalid) continue;
      samples[mask.raw[i] - std::size_t{1}].push_back(cloud.points[i]);
    }
  }
  return samples;
}

/// Length along an axis without `kTrim` of the points at either end [m].
float extent(const Points& points, const Eigen::Vector3f& axis) {
  std::vector<float> along;
  for (const Eigen::Vector3f& point : points) along.push_back(axis.dot(point));
  const auto cut = static_cast<std::ptrdiff_t>(kTrim * static_cast<double>(along.size()));
  std::nth_element(along.begin(), along.begin() + cut, along.end());
  const float low = along[static_cast<std::size_t>(cut)];
  std::nth_element(along.begin(), along.end() - 1 - cut, along.end());
  return *(along.end() - 1 - cut) - low;
}

struct Plane {
  Eigen::Vector3f mean;
  PrincipalAxes<float, 3> axes;

  explicit Plane(const Points& points) {
    const auto scatter = scatter_of(points);
    mean = scatter.mean;
    axes = principal_axes<float, 3>(scatter.matrix);
  }
  float distance(const Eigen::Vector3f& point) const {
    return std::abs(axes.smallest().dot(point - mean));
  }
};

/// Whether the points are larger along two axes than objects of the class are tall. A trimmed
/// extent is corrected to that of points evenly spaced.
bool is_too_large(const Points& points, const ObjectSize& size) {
  const Plane plane(points);
  const double whole = 1.0 / (1.0 - 2.0 * kTrim);
  return whole * extent(points, plane.axes.axes.col(1)) > kMaxHeight * size.length;
}

bool is_flat(const Points& points, const FusionConfig& config) {
  Plane plane(points);
  const float noise = config.noise.depth.sigma(plane.mean.z());
  if (config.planes.distance_limit(noise) > kMaxTolerance) return false;
  for (int round = 0; round < kRounds; ++round) {
    Points near = points;
    const auto fitted = static_cast<std::ptrdiff_t>(kFitted * static_cast<double>(near.size()));
    std::nth_element(near.begin(), near.begin() + fitted, near.end(),
                     [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
                       return plane.distance(a) < plane.distance(b);
                     });
    near.resize(static_cast<std::size_t>(fitted));
    plane = Plane(near);
  }
  Points on_plane;
  for (const Eigen::Vector3f& point : points) {
    const float limit = config.planes.distance_limit(config.noise.depth.sigma(point.z()));
    if (plane.distance(point) <= limit) on_plane.push_back(point);
  }
  if (static_cast<double>(on_plane.size()) < kFlatShare * static_cast<double>(points.size())) {
    return false;
  }
  return extent(on_plane, plane.axes.axes.col(1)) > kFlatWidth &&
         extent(on_plane, plane.axes.largest()) > kFlatLength;
}

}  // namespace

int clear_implausible_masks(const LabeledCloud& cloud, const std::vector<Instance>& instances,
                            const FusionConfig& config, MaskImage& mask) {
  const std::vector<Points> samples = sample(cloud, instances.size(), mask);
  std::vector<bool> cleared(instances.size() + 1, false);
  int count = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (samples[k].size() < kMinSamples) continue;
    const ObjectClass object_class = instances[k].object_class;
    const ObjectSize& size = config.sizes[static_cast<std::size_t>(object_class)];
    const bool flat = object_class == ObjectClass::kPerson && is_flat(samples[k], config);
    if (!flat && !is_too_large(samples[k], size)) continue;
    cleared[k + 1] = true;
    ++count;
  }
  if (count == 0) return 0;
  for (std::size_t i = 0; i < mask.raw.size(); ++i) {
    if (cleared[mask.raw[i]]) mask.raw[i] = 0;
    if (cleared[mask.dilated[i]]) mask.dilated[i] = 0;
  }
  return count;
}

}  // namespace mms
