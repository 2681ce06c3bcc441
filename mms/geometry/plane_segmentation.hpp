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

/// A point that votes for planes; without a normal (zero) it has no vote.
struct PlaneSample {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;  ///< unit or zero
  float area;              ///< of surface it stands for [m^2]
  float tolerance;         ///< distance at which it is still on a plane [m]
};

/// What counts as a plane, see `find_planes`.
struct PlaneSearch {
  float min_area = 0.05F;         ///< of all its samples [m^2]
  float min_extent = 0.2F;        ///< along the shorter principal axis [m]
  float min_share = 0.02F;        ///< of the samples
  float max_normal_angle = 0.4F;  ///< between sample and plane [rad]
  int max_planes = 6;
  int hypotheses = 32;
};

/// True where `sample` lies on `plane` within its tolerance and faces the same way (either side) up
/// to an angle with cosine `min_cosine`; false without a normal.
bool is_on_plane(const PlaneSample& sample, const Plane& plane, float min_cosine);

/// Large planes among the samples. Hypotheses are fitted around evenly drawn samples, tried in the
/// order of their areas and refined by least squares; a plane's samples are taken out before the
/// next is tried. Deterministic: no random numbers.
std::vector<Plane> find_planes(std::vector<PlaneSample> samples, const PlaneSearch& search);

}  // namespace mms
