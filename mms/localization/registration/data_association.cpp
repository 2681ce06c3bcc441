#include "mms/localization/registration/data_association.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "mms/geometry/parallel.hpp"
#include "mms/geometry/principal_axes.hpp"

namespace mms {
namespace {

/// [-]: features of one parallel task. Source: tens of microseconds, long against the task's start.
constexpr std::size_t kChunk = 256;

/// [-]: largest standard deviation across a line over that along it.
/// Source: initial choice; a disc has 1, noise of 1 cm on 10 cm of line 0.35.
constexpr float kMaxLineAspect = 0.6F;

/// [-]: points of the shortest line. Source: those of one voxel's side in `LocalMaps`, 0.2 apart.
constexpr std::size_t kMinLinePoints = 5;

/// [voxels]: least distance of the two points of a line, and root of twice the least area of the
/// three points of a plane. Source: half the spacing of `LocalMaps`, so that only rounding and
/// points of neighboring voxels are excluded.
constexpr float kMinSeparation = 0.1F;

struct Line {
  Eigen::Vector3f point;
  Eigen::Vector3f direction;  ///< unit
  float sigma = 0.0F;         ///< spread of its points across it [m]
};

struct Plane {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;  ///< unit
  float sigma = 0.0F;      ///< of the plane along its normal [m]
};

std::optional<Line> line_of_two(const std::vector<Neighbor>& n, float min_separation) {
  if (n.size() < 2) return std::nullopt;
  const Eigen::Vector3f along = n[1].point - n[0].point;
  if (along.norm() < min_separation) return std::nullopt;
  return Line{n[0].point, along.normalized()};
}

std::optional<Line> principal_line(const std::vector<Neighbor>& n) {
  if (n.size() < kMinLinePoints) return std::nullopt;
  const auto scatter = scatter_of(n, &Neighbor::point);
  const auto axes = principal_axes(scatter.matrix, EigenMethod::kClosedForm);
  const Eigen::Vector3f& squares = axes.variances;
  if (squares(1) > kMaxLineAspect * kMaxLineAspect * squares(2)) return std::nullopt;
  // By rounding, points that lie exactly on a line have a variance below zero.
  const float across = std::max(0.0F, squares(1)) / static_cast<float>(n.size());
  return Line{scatter.mean, axes.largest(), std::sqrt(across)};
}

std::optional<Plane> plane_of_three(const std::vector<Neighbor>& n, float min_separation) {
  if (n.size() < 3) return std::nullopt;
  const Eigen::Vector3f cross = (n[0].point - n[1].point).cross(n[0].point - n[2].point);
  if (cross.norm() < min_separation * min_separation) return std::nullopt;
  return Plane{n[0].point, cross.normalized()};
}

/// Finds the counterparts of single features.
class Matcher {
 public:
  Matcher(const LocalMaps& maps, const Eigen::Isometry3d& T, Association association, double gate)
      : maps_(maps),
        T_(T.cast<float>()),
        paper_(association == Association::kPaper),
        gate_(static_cast<float>(gate)) {}

  std::optional<EdgeMatch> match(const EdgeFeature& edge) {
    const auto line = line_at(T_ * edge.point);
    if (!line) return std::nullopt;
    return EdgeMatch{edge.point.cast<double>(), line->point.cast<double>(),
                     line->direction.cast<double>(),
                     std::hypot(static_cast<double>(edge.sigma), static_cast<double>(line->sigma))};
  }

  std::optional<PlaneMatch> match(const PlaneFeature& feature) {
    const Eigen::Vector3f target = T_ * feature.point;
    const auto plane = plane_at(target, T_.linear() * feature.normal);
    if (!plane || std::abs(plane->normal.dot(target - plane->point)) > gate_) return std::nullopt;
    // Depth noise acts along the ray; the residual sees its part along the normal.
    const float incidence = feature.normal.dot(feature.point) / feature.point.norm();
    const double sigma = std::hypot(feature.sigma * incidence, plane->sigma);
    return PlaneMatch{feature.point.cast<double>(), plane->point.cast<double>(),
                      plane->normal.cast<double>(), sigma};
  }

 private:
  float min_separation() const { return kMinSeparation * maps_.voxel_size(); }

  std::optional<Line> line_at(const Eigen::Vector3f& target) {
    if (paper_) {
      maps_.edges.nearest(target, 2, gate_, neighbors_);
      return line_of_two(neighbors_, min_separation());
    }
    maps_.edges.within(target, std::min(gate_, maps_.voxel_size()), neighbors_);
    return principal_line(neighbors_);
  }

  std::optional<Plane> plane_at(const Eigen::Vector3f& target, const Eigen::Vector3f& normal) {
    if (paper_) {
      maps_.plane_points.nearest(target, 3, gate_, neighbors_);
      return plane_of_three(neighbors_, min_separation());
    }
    const auto surface = maps_.surfaces.match(target, normal);
    if (!surface) return std::nullopt;
    return Plane{surface->mean, surface->normal, surface->sigma};
  }

  const LocalMaps& maps_;
  Eigen::Isometry3f T_;
  bool paper_;
  float gate_;
  std::vector<Neighbor> neighbors_;
};

/// Matches of all features that have one, in the order of the features.
template <class Match, class Feature, class MakeMatcher>
std::vector<Match> match_all(const std::vector<Feature>& features, const MakeMatcher& matcher) {
  std::vector<std::optional<Match>> found(features.size());
  parallel_chunks(features.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    Matcher local = matcher();
    for (std::size_t i = begin; i < end; ++i) found[i] = local.match(features[i]);
  });
  std::vector<Match> matches;
  matches.reserve(features.size());
  for (const auto& match : found) {
    if (match) matches.push_back(*match);
  }
  return matches;
}

}  // namespace

Matches associate(const FeatureCloud& features, const LocalMaps& maps,
                  const Eigen::Isometry3d& T_world_sensor, Association association, double gate) {
  const auto matcher = [&] { return Matcher(maps, T_world_sensor, association, gate); };
  return {match_all<EdgeMatch>(features.edges, matcher),
          match_all<PlaneMatch>(features.planes, matcher)};
}

}  // namespace mms
