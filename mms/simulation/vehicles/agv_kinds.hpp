#pragma once

#include <cstdint>
#include <memory>

#include "mms/simulation/models/articulated_model.hpp"

namespace mms {

/// Constructors of the kinds; see AgvKind.
std::unique_ptr<ArticulatedModel> make_grabbing_agv(std::uint64_t seed);
std::unique_ptr<ArticulatedModel> make_forklift(std::uint64_t seed);
std::unique_ptr<ArticulatedModel> make_scanning_agv(std::uint64_t seed);
std::unique_ptr<ArticulatedModel> make_pioneer(std::uint64_t seed);
std::unique_ptr<ArticulatedModel> make_transport_agv(std::uint64_t seed);

}  // namespace mms
