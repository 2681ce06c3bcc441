#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace mms {

/// Infinite plane: normal . p + offset = 0.
struct Plane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  ///< unit
  float offset = 0.0F;                                ///< [m]

  float distance(const Eigen::Vector3f& point) const {
    return std::abs(normal.dot(point) + offset);
  }
};

/// Point that votes for planes; without a normal (zero) it has no vote.
struct PlaneSample {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;  ///< unit or zero
  float area;              ///< surface area that it represents [m^2]
  float tolerance;         ///< largest distance to a plane [m]
};

/// Criteria of `find_planes`.
struct PlaneSearch {
  float min_area = 0.05F;         ///< total area of its samples [m^2]
  float min_extent = 0.2F;        ///< along the shorter principal axis [m]
  float min_share = 0.02F;        ///< share of the samples
  float max_normal_angle = 0.4F;  ///< between sample and plane normal [rad]
  int max_planes = 6;
  int hypotheses = 32;
};

/// Whether `sample` lies on `plane` within its tolerance and their normals agree up to sign and an
/// angle with cosine `min_cosine`; false without a normal.
bool is_on_plane(const PlaneSample& sample, const Plane& plane, float min_cosine);

/// Large planes among the samples. Hypotheses are fitted around evenly spaced samples, tried in
/// order of area and refined by least squares; the samples of a plane are removed before the next
/// one. Deterministic.
std::vector<Plane> find_planes(std::vector<PlaneSample> samples, const PlaneSearch& search);

}  // namespace mms
