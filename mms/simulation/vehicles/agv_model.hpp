#pragma once

#include <cstdint>
#include <memory>

#include "mms/simulation/models/articulated_model.hpp"

namespace mms {

/// The five types of automated guided vehicles in the paper's warehouse.
enum class AgvKind : std::uint8_t { kGrabbing, kForklift, kScanning, kPioneer, kTransport };
inline constexpr int kAgvKindCount = 5;

/// A vehicle whose wheels roll by the distance travelled and whose arm, mast, head or rollers move
/// with time. The seed determines colors, sizes, load and motion. kind() is "grabbing_agv",
/// "forklift", "scanning_agv", "pioneer" or "transport_agv".
std::unique_ptr<ArticulatedModel> make_agv(AgvKind kind, std::uint64_t seed);

}  // namespace mms
