#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/global_map/keyframes/scan_signature.hpp"
#include "mms/global_map/loops/loop.hpp"
#include "mms/global_map/loops/loop_config.hpp"
#include "mms/global_map/loops/loop_verification.hpp"

namespace mms {

/// The keyframes among which the place of a single scan is searched.
struct KnownScans {
  const std::deque<KeyframeRecord>& records;
  const std::vector<Eigen::Isometry3d>& poses;
  const ScanPlaces& places;
  const LoopVerifier& verifier;
  ScanPlaces::IsUsable is_usable;
  std::function<bool(std::size_t a, std::size_t b)> share_frame;  ///< whether poses of two do
};

/// The place of a single scan. It must pass all checks of a loop, and all other places that look
/// similar must fail clearly: halls may be nearly symmetric.
/// @returns nothing if it is not sure
std::optional<Loop> find_place_of_scan(const KnownScans& known, const LoopConfig& config,
                                       const KeyframeRecord& query);

}  // namespace mms
