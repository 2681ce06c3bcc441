#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mms {

enum class LidarPattern : std::uint8_t {
  kSpinning,  ///< rings at fixed elevations that rotate once per scan
  kRosette,   ///< non-repeating rosette of a solid-state scanner (Livox-like)
};

struct LidarSensor {
  LidarPattern pattern = LidarPattern::kSpinning;
  int rings = 16;      ///< of a spinning one, evenly spaced from elevation_max to elevation_min
  int columns = 1800;  ///< firings per ring and rotation
  double elevation_min = -0.26;  ///< [rad]
  double elevation_max = 0.26;   ///< [rad]
  double field = 0.61;           ///< half the opening angle of a rosette [rad]
  int points = 24000;            ///< points of a rosette per scan
  double min_range = 0.5;        ///< [m]
  double max_range = 100.0;      ///< for a reflectance of 80 % [m]
  double noise = 0.02;           ///< standard deviation of range [m]
};

/// One shot of the laser.
struct Beam {
  Eigen::Vector3f direction;  ///< unit, LiDAR frame (x forward, y left, z up)
  float time_offset;          ///< relative to the scan's start, in [0, period) [s]
};

/// Shots of scan `index` (>= 0) in order of time; a scan takes `period` [s]. A spinning LiDAR
/// rotates clockwise from above, starts at the rear and fires all rings simultaneously, listed from
/// the highest to the lowest; its columns are not synchronous with the rotation, so scans differ by
/// a fraction of a column. A rosette continues the previous scan.
std::vector<Beam> beams(const LidarSensor& sensor, int index, double period);

/// Measured range [m], 0 for no return: beyond the range, which grows with the root of the returned
/// light (reflectance times cosine), at grazing incidence, or reflected away (gloss^2 of the shots
/// whose cosine is below 0.7). Deterministic for a `hash`.
float measured_range(float range, float cosine, float reflectance, float gloss,
                     const LidarSensor& sensor, std::uint64_t hash);

}  // namespace mms
