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

/// [-]: share of a mask's samples with a return below which it is doubtful. Source: initial choice;
/// hair and dark clothes lack returns, but seldom most of a body.
constexpr double kFewReturns = 0.3;

/// [-]: largest second extent, in lengths of the class. Source: initial choice; people side by side
/// under one mask are wider than that, but not taller.
constexpr double kMaxHeight = 1.2;

/// [-]: the same from which a mask is doubtful. Source: as tall as the class.
constexpr double kDoubtfulHeight = 1.0;

/// [m]: shorter side of a flat surface that is no person. Source: wider than a torso.
constexpr float kFlatWidth = 0.5F;

/// [m]: its longer side. Source: longer than a torso from neck to hip.
constexpr float kFlatLength = 0.8F;

/// [-]: share of the samples on it. Source: initial choice; of a standing person's front the torso
/// is flat, with head, arms and legs before and behind it.
constexpr double kFlatShare = 0.85;

/// [-]: the same from which a mask is doubtful. Source: initial choice.
constexpr double kDoubtfulFlatShare = 0.7;

/// [m]: tolerance of the plane, noise included, up to which a flat surface differs from a body.
/// Source: a fifth of a torso's radius of 0.17 m; a Kinect's noise reaches it at 3 m.
constexpr float kMaxTolerance = 0.036F;

/// [-]: rounds in which the plane is fitted again to the samples near it. Source: initial choice.
constexpr int kRounds = 3;

/// [-]: share of the samples nearest to the plane that it is fitted to. Source: as `kFlatShare`.
constexpr double kFitted = 0.8;

using Points = std::vector<Eigen::Vector3f>;

/// What was sampled of one mask.
struct Samples {
  Points points;
  std::size_t without_return = 0;
};

/// Of every fourth point of an image along either axis, or of all points of a scan.
std::vector<Samples> sample(const LabeledCloud& cloud, std::size_t instances,
                            const std::vector<std::uint16_t>& covering) {
  std::vector<Samples> samples(instances);
  const int step = cloud.organised() ? kStep : 1;
  for (int y = 0; y < cloud.height; y += step) {
    for (int x = 0; x < cloud.width; x += step) {
      const std::size_t i = cloud.index(x, y);
      if (covering[i] == 0) continue;
      Samples& of_mask = samples[covering[i] - std::size_t{1}];
      if (cloud.labels[i] == PointLabel::kInvalid) {
        ++of_mask.without_return;
      } else {
        of_mask.points.push_back(cloud.points[i]);
      }
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

/// Second largest extent of the points [m]. A trimmed one is corrected to that of points evenly
/// spaced.
double second_extent(const Points& points) {
  return extent(points, Plane(points).axes.axes.col(1)) / (1.0 - 2.0 * kTrim);
}

/// Whether the points are a flat surface larger than a body.
/// @param tolerance  of the plane at a point [m]
template <class Tolerance>
Plausibility judge_flatness(const Points& points, const Tolerance& tolerance) {
  Plane plane(points);
  const bool is_near = tolerance(plane.mean) <= kMaxTolerance;
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
    if (plane.distance(point) <= tolerance(point)) on_plane.push_back(point);
  }
  const double share = static_cast<double>(on_plane.size()) / static_cast<double>(points.size());
  const bool is_flat = share >= kDoubtfulFlatShare &&
                       extent(on_plane, plane.axes.axes.col(1)) > kFlatWidth &&
                       extent(on_plane, plane.axes.largest()) > kFlatLength;
  if (!is_flat) return Plausibility::kPlausible;
  return is_near && share >= kFlatShare ? Plausibility::kImpossible : Plausibility::kDoubtful;
}

template <class Tolerance>
Plausibility judge(const Samples& samples, ObjectClass object_class, const ObjectSize& size,
                   const Tolerance& tolerance) {
  const Points& points = samples.points;
  const std::size_t all = points.size() + samples.without_return;
  const bool has_few = static_cast<double>(points.size()) < kFewReturns * static_cast<double>(all);
  Plausibility judged = has_few ? Plausibility::kDoubtful : Plausibility::kPlausible;
  if (points.size() < kMinSamples) return judged;
  const double height = second_extent(points) / size.length;
  if (height > kMaxHeight) return Plausibility::kImpossible;
  if (height > kDoubtfulHeight) judged = Plausibility::kDoubtful;
  return object_class == ObjectClass::kPerson ? std::max(judged, judge_flatness(points, tolerance))
                                              : judged;
}

}  // namespace

std::vector<Plausibility> judge_masks(const LabeledCloud& cloud,
                                      const std::vector<std::uint16_t>& covering,
                                      const std::vector<Instance>& instances,
                                      const FusionConfig& config) {
  const std::vector<Samples> samples = sample(cloud, instances.size(), covering);
  const auto range_noise = static_cast<float>(config.noise.range);
  // One standard deviation: with more, the fronts of people side by side are flat at 3 m.
  const auto tolerance = [&](const Eigen::Vector3f& point) {
    const float sigma = cloud.organised() ? config.noise.depth.sigma(point.z()) : range_noise;
    return static_cast<float>(config.planes.tolerance) + sigma;
  };
  std::vector<Plausibility> judged;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const ObjectClass object_class = instances[k].object_class;
    judged.push_back(judge(samples[k], object_class,
                           config.sizes[static_cast<std::size_t>(object_class)], tolerance));
  }
  return judged;
}

}  // namespace mms
