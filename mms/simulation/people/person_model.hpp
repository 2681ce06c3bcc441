#pragma once

#include <cstddef>
#include <memory>

#include "mms/simulation/models/articulated_model.hpp"
#include "mms/simulation/people/person_style.hpp"

namespace mms {

/// Order of the parts of a person.
struct PersonPart {
  enum : std::size_t {
    kPelvis,
    kTorso,
    kHead,
    kLeftUpperArm,
    kRightUpperArm,
    kLeftForearm,  ///< including the hand
    kRightForearm,
    kLeftThigh,
    kRightThigh,
    kLeftShank,
    kRightShank,
    kLeftShoe,
    kRightShoe,
    kCarriedBox,  ///< only if carries_box
  };
};

/// A person who walks if its activity has a speed, and otherwise stands or works. A step is 0.75 of
/// the leg length.
/// @throws Error if the height is outside [1.2, 2.2] m or the build outside [0.7, 1.5].
std::unique_ptr<ArticulatedModel> make_person(const PersonStyle& style);

}  // namespace mms
