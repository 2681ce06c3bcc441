#include "mms/geometry/plane_segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "mms/geometry/principal_axes.hpp"

namespace mms {
namespace {

/// A hypothesis is fitted to the samples within this radius of its seed [m] and within their
/// tolerance plus this slope times the distance, because the seed's normal is noisy.
constexpr float kSeedRadius = 0.6F;
constexpr float kSeedSlope = 0.15F;
constexpr int kRefinements = 2;

/// Cosine of the largest angle (0.12 rad) between a plane and the mean normal of its samples: a
/// plane through steps or clutter is oblique to the surfaces it crosses.
constexpr float kMinCosine = 0.9928F;

/// Area-weighted moments of a plane's samples.
struct Moments {
  PointSums<double, 3> points;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();

  void add(const PlaneSample& sample) {
    const double area = sample.area;
    points.add(sample.point.cast<double>(), area);
    normal += area * sample.normal.cast<double>();
  }
};

struct Fit {
  Plane plane;
  float area = 0.0F;    ///< [m^2]
  float extent = 0.0F;  ///< shorter side of the rectangle with the same second moments [m]
  float cosine = 0.0F;  ///< cosine between the plane's normal and the mean normal of its samples
  int count = 0;
};

std::optional<Fit> fit_plane(const Moments& moments) {
  const PointSums<double, 3>& points = moments.points;
  if (points.count() < 3 || !(points.weight() > 0.0)) return std::nullopt;
  const auto axes = principal_axes(points.covariance());
  const Eigen::Vector3d normal = axes.smallest();
  Fit fit;
  fit.plane = {normal.cast<float>(), static_cast<float>(-normal.dot(points.mean()))};
  fit.area = static_cast<float>(points.weight());
  fit.extent = static_cast<float>(std::sqrt(12.0 * std::max(0.0, axes.variances(1))));
  fit.cosine = static_cast<float>(std::abs(normal.dot(moments.normal.normalized())));
  fit.count = points.count();
  return fit;
}

bool agrees(const PlaneSample& sample, const Plane& plane, float min_cosine, float limit) {
  return plane.distance(sample.point) <= limit &&
         std::abs(plane.normal.dot(sample.normal)) >= min_cosine;
}

struct Hypothesis {
  PlaneSample seed;
  Plane plane;
  float area = 0.0F;  ///< total of the samples on it [m^2]
};

/// Plane fitted around `seed`.
std::optional<Plane> local_plane(const std::vector<PlaneSample>& samples, const PlaneSample& seed,
                                 float min_cosine) {
  const Plane tangent{seed.normal, -seed.normal.dot(seed.point)};
  Moments moments;
  for (const PlaneSample& sample : samples) {
    const float distance2 = (sample.point - seed.point).squaredNorm();
    if (distance2 > kSeedRadius * kSeedRadius) continue;
    const float limit = sample.tolerance + kSeedSlope * std::sqrt(distance2);
    if (agrees(sample, tangent, min_cosine, limit)) moments.add(sample);
  }
  const std::optional<Fit> fit = fit_plane(moments);
  return fit ? std::optional<Plane>(fit->plane) : std::nullopt;
}

/// Planes around evenly spaced samples, largest area first.
std::vector<Hypothesis> draw_hypotheses(const std::vector<PlaneSample>& samples, int count,
                                        float min_cosine) {
  std::vector<Hypothesis> hypotheses;
  for (int k = 0; k < count && !samples.empty(); ++k) {
    const std::size_t drawn = (2 * static_cast<std::size_t>(k) + 1) * samples.size() /
                              (2 * static_cast<std::size_t>(count));
    const std::optional<Plane> plane = local_plane(samples, samples[drawn], min_cosine);
    if (!plane) continue;
    hypotheses.push_back({samples[drawn], *plane, 0.0F});
    for (const PlaneSample& sample : samples) {
      if (is_on_plane(sample, *plane, min_cosine)) hypotheses.back().area += sample.area;
    }
  }
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.area > b.area; });
  return hypotheses;
}

/// Iterated least squares over the samples on the plane.
std::optional<Fit> refine(const std::vector<PlaneSample>& samples, Plane plane, float min_cosine) {
  std::optional<Fit> fit;
  for (int pass = 0; pass < kRefinements; ++pass) {
    Moments moments;
    for (const PlaneSample& sample : samples) {
      if (is_on_plane(sample, plane, min_cosine)) moments.add(sample);
    }
    fit = fit_plane(moments);
    if (!fit) return std::nullopt;
    plane = fit->plane;
  }
  return fit;
}

}  // namespace

bool is_on_plane(const PlaneSample& sample, const Plane& plane, float min_cosine) {
  return agrees(sample, plane, min_cosine, sample.tolerance);
}

std::vector<Plane> find_planes(std::vector<PlaneSample> samples, const PlaneSearch& search) {
  std::erase_if(samples, [](const PlaneSample& s) { return s.normal.isZero(0.0F); });
  const float min_count = search.min_share * static_cast<float>(samples.size());
  const float min_cosine = std::cos(search.max_normal_angle);
  std::vector<Plane> planes;
  for (const Hypothesis& start : draw_hypotheses(samples, search.hypotheses, min_cosine)) {
    if (static_cast<int>(planes.size()) >= search.max_planes || start.area < search.min_area) break;
    const bool is_taken = std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
      return is_on_plane(start.seed, plane, min_cosine);
    });
    if (is_taken) continue;
    const std::optional<Fit> fit = refine(samples, start.plane, min_cosine);
    const bool is_large = fit && fit->area >= search.min_area && fit->extent >= search.min_extent &&
                          static_cast<float>(fit->count) >= min_count;
    if (!is_large || fit->cosine < kMinCosine) continue;
    planes.push_back(fit->plane);
    std::erase_if(samples, [&](const PlaneSample& sample) {
      return is_on_plane(sample, planes.back(), min_cosine);
    });
  }
  return planes;
}

}  // namespace mms
