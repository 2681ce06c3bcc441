#pragma once

#include "mms/simulation/models/mesh.hpp"
#include "mms/simulation/people/person_proportions.hpp"
#include "mms/simulation/people/person_style.hpp"

namespace mms {

/// Shapes of the parts of a person. Every part has x forward, z up and its origin at its joint:
/// pelvis between the hips, torso at the waist, head at the base of the neck, limbs at their upper
/// joint with the limb along -z, shoe at the ankle. `side` is +1 on the left and -1 on the right.
Mesh make_pelvis(const PersonStyle& style, const PersonProportions& body);
Mesh make_torso(const PersonStyle& style, const PersonProportions& body);
Mesh make_head(const PersonStyle& style, const PersonProportions& body);
Mesh make_upper_arm(const PersonStyle& style, const PersonProportions& body);
Mesh make_forearm(const PersonStyle& style, const PersonProportions& body, float side);
Mesh make_thigh(const PersonStyle& style, const PersonProportions& body);
Mesh make_shank(const PersonStyle& style, const PersonProportions& body);
Mesh make_shoe(const PersonStyle& style, const PersonProportions& body);

/// A cardboard box in the frame of the torso, in front of the body.
Mesh make_carried_box(const PersonStyle& style, const PersonProportions& body);

/// Half extent of that box [m] and its center in the frame of the torso [m].
Eigen::Vector3f carried_box_half(const PersonStyle& style);
Eigen::Vector3f carried_box_center(const PersonStyle& style, const PersonProportions& body);

/// Materials of garments and skin.
Material cloth(const Eigen::Vector3f& color, std::uint32_t seed);
Material skin_of(const PersonStyle& style);
Material reflective_band();

}  // namespace mms
