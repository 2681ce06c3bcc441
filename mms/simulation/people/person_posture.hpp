#pragma once

#include <Eigen/Geometry>
#include <array>

#include "mms/simulation/people/person_gait.hpp"
#include "mms/simulation/people/person_style.hpp"

namespace mms {

/// Upper body of a person in the object frame. Index 0 is left, 1 right.
struct Posture {
  Eigen::Isometry3f T_object_torso;
  Eigen::Isometry3f T_object_head;
  std::array<Eigen::Vector3f, 2> shoulders;  ///< [m]
  std::array<Eigen::Vector3f, 2> wrists;     ///< [m]
  float palms_down = 0.0F;                   ///< rotation of the forearms about their axis [rad]
  std::array<Eigen::Vector3f, 2>
      arm_forward;  ///< forward direction of each arm; elbows bend backward
};

/// Torso, head and hands of a person who walks, stands, works at a rack or carries a box.
Posture posture_of(const PersonStyle& style, const PersonProportions& body, const Gait& gait,
                   double seconds);

}  // namespace mms
