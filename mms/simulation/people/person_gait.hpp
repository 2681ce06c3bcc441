#pragma once

#include <Eigen/Geometry>
#include <array>

#include "mms/simulation/models/articulated_model.hpp"
#include "mms/simulation/people/person_proportions.hpp"

namespace mms {

/// Length of one step over the length of the leg.
inline constexpr float kStepOverLeg = 0.75F;

/// Lower half of a walking or standing person in the object frame. Index 0 is left, 1 right.
struct Gait {
  float amount = 0.0F;  ///< 0 standing, 1 walking
  float phase = 0.0F;   ///< of the left foot in a stride of two steps, 0 at its heel strike [rad]
  Eigen::Isometry3f T_object_pelvis;
  std::array<Eigen::Isometry3f, 2> T_object_foot;  ///< frames of the shoes, at the ankles
};

/// Feet that stand still on the floor while their leg bears the body and swing forward above it
/// otherwise; hips as high as the legs that bear them allow.
Gait gait_of(const PersonProportions& body, const Activity& activity, std::uint32_t seed);

}  // namespace mms
