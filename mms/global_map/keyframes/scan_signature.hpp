#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "mms/global_map/keyframes/scan_view.hpp"

namespace mms {

/// Heights of the static surroundings of a single scan by distance and direction, as in Scan
/// Context (Kim and Kim, IROS 2018).
struct ScanSignature {
  static constexpr std::size_t kRings = 30;     ///< 1 m wide each
  static constexpr std::size_t kSectors = 120;  ///< 3 degrees wide each

  std::vector<std::uint8_t> heights;     ///< [2 cm], 0 for none; sector by sector
  std::array<float, kRings> occupied{};  ///< share of the sectors, the same for any heading

  bool empty() const { return heights.empty(); }
};

ScanSignature scan_signature(const ScanView& scan);

/// A keyframe whose scan is like another one.
struct SimilarScan {
  std::size_t keyframe = 0;
  double turn = 0.0;        ///< about its up axis, by which the other one is turned [rad]
  double similarity = 0.0;  ///< up to 1
};

/// Finds keyframes by single scans: a sensor that is lost, or stands, has no local map.
class ScanPlaces {
 public:
  using IsUsable = std::function<bool(std::size_t keyframe)>;

  /// Adds the next keyframe; the first one is number 0.
  void add(const ScanView& scan) { signatures_.push_back(scan_signature(scan)); }

  /// @param is_usable  whether a keyframe may be a candidate
  /// @returns the most similar ones first, of a group of successive keyframes one
  std::vector<SimilarScan> find(const ScanView& scan, const IsUsable& is_usable,
                                std::size_t max_count) const;

 private:
  std::vector<ScanSignature> signatures_;  ///< by keyframe
};

}  // namespace mms
