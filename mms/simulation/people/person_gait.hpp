#pragma once

#include <Eigen/Geometry>
#include <array>

#include "mms/simulation/models/articulated_model.hpp"
#include "mms/simulation/people/person_proportions.hpp"

namespace mms {

/// Ratio of step length and leg length.
inline constexpr float kStepOverLeg = 0.75F;

/// Lower body of a walking or standing person in the object frame. Index 0 is left, 1 right.
struct Gait {
  float amount = 0.0F;  ///< 0 standing, 1 walking
  float phase =
      0.0F;  ///< phase of the left foot in a stride of two steps, 0 at its heel strike [rad]
  Eigen::Isometry3f T_object_pelvis;
  std::array<Eigen::Isometry3f, 2> T_object_foot;  ///< frames of the shoes, at the ankles
};

/// Computes the lower body: the stance foot is static on the floor, the other one swings forward
/// above it; the hips are as high as the stance legs allow.
Gait gait_of(const PersonProportions& body, const Activity& activity, std::uint32_t seed);

}  // namespace mms
