#pragma once

#include <cstdint>
#include <memory>

#include "mms/simulation/models/articulated_model.hpp"

namespace mms {

/// The five types of automated guided vehicles in the paper's warehouse.
enum class AgvKind : std::uint8_t { kGrabbing, kForklift, kScanning, kPioneer, kTransport };
inline constexpr int kAgvKindCount = 5;

/// A vehicle whose wheels roll as far as it has travelled and whose arm, mast, head or rollers move
/// with time. The seed chooses colours, sizes, load and habits. kind() is "grabbing_agv",
/// "forklift", "scanning_agv", "pioneer" or "transport_agv".
std::unique_ptr<ArticulatedModel> make_agv(AgvKind kind, std::uint64_t seed);

}  // namespace mms
