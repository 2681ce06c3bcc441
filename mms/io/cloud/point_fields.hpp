#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "mms/core/time.hpp"

namespace mms {

/// Customary names of the intensity of a LiDAR's points; the first one present counts.
inline constexpr std::array<std::string_view, 5> kIntensityNames = {
    "intensity", "scalar_Intensity", "reflectivity", "reflectance", "i"};

/// Customary names of the time of a LiDAR's points; the first one present counts.
inline constexpr std::array<std::string_view, 5> kPointTimeNames = {"t", "time", "timestamp",
                                                                    "time_offset", "offset_time"};

/// Times of a scan's points.
struct PointTimes {
  std::vector<float> offsets{};  ///< relative to the scan's stamp [s]
  /// Whether they were neither within 1 s of the stamp nor relative to it: they are relative to the
  /// earliest one then.
  bool other_clock = false;
};

/// Times of a scan's points relative to its stamp, in the unit (s, us, ns) that gives a scan a
/// plausible duration. Times since an epoch, or since the sensor was turned on, become relative to
/// `stamp`.
/// @param times    as stored; one that is not finite becomes 0
/// @param integer  stored as integers, which are never seconds
/// @param stamp    of the scan; if unknown, times since an epoch become relative to the earliest
/// one
/// @returns no offsets if no time is finite
PointTimes relative_point_times(const std::vector<double>& times, bool integer,
                                std::optional<Timestamp> stamp);

}  // namespace mms
