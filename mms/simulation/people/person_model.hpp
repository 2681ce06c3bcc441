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
    kLeftForearm,  ///< with the hand
    kRightForearm,
    kLeftThigh,
    kRightThigh,
    kLeftShank,
    kRightShank,
    kLeftShoe,
    kRightShoe,
    kCarriedBox,  ///< only of those who carry one
  };
};

/// A person who walks when its activity has a speed and stands, or works, otherwise. Steps are as
/// long as the legs ask for: 0.75 of their length from heel to heel.
/// @throws Error when the height is not in [1.2, 2.2] m or the build not in [0.7, 1.5].
std::unique_ptr<ArticulatedModel> make_person(const PersonStyle& style);

}  // namespace mms
