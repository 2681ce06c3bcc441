#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mms {

enum class LidarPattern : std::uint8_t {
  kSpinning,  ///< rings at fixed elevations that turn once a scan
  kRosette,   ///< a solid-state scanner's flower that never repeats (Livox-like)
};

struct LidarSensor {
  LidarPattern pattern = LidarPattern::kSpinning;
  int rings = 16;                ///< of a spinning one, evenly from elevation_max to elevation_min
  int columns = 1800;            ///< firings of each ring in a turn
  double elevation_min = -0.26;  ///< [rad]
  double elevation_max = 0.26;   ///< [rad]
  double field = 0.61;           ///< half the opening angle of a rosette [rad]
  int points = 24000;            ///< of a rosette in a scan
  double min_range = 0.5;        ///< [m]
  double max_range = 100.0;      ///< of a surface that returns 80 % of the light [m]
  double noise = 0.02;           ///< one sigma of range [m]
};

/// One shot of the laser.
struct Beam {
  Eigen::Vector3f direction;  ///< unit, LiDAR frame (x forward, y left, z up)
  float time_offset;          ///< since the scan's start, in [0, period) [s]
};

/// Shots of scan `index` (0 and up) in the order of their time; a scan lasts `period` [s]. A
/// spinning one turns clockwise seen from above, begins behind and fires all its rings at once,
/// from the highest to the lowest; its columns are not in step with the turn, so scans differ by a
/// part of a column. A rosette goes on where the scan before ended.
std::vector<Beam> beams(const LidarSensor& sensor, int index, double period);

/// Range as measured [m], 0 for no return: beyond the range, which grows with the root of the light
/// returned (reflectance times cosine), nearly along the surface, or mirrored elsewhere (gloss^2
/// of the shots whose cosine is below 0.7). `hash` decides.
float measured_range(float range, float cosine, float reflectance, float gloss,
                     const LidarSensor& sensor, std::uint64_t hash);

}  // namespace mms
