#pragma once

#include <filesystem>
#include <vector>

namespace mms {

/// Corrections of a laser of an HDL-64E.
struct LaserCorrection {
  double elevation = 0.0;          ///< of the beam [rad]
  double azimuth = 0.0;            ///< subtracted from the rotation [rad]
  double distance = 0.0;           ///< added [m]
  double vertical_offset = 0.0;    ///< of the laser [m]
  double horizontal_offset = 0.0;  ///< of the laser [m]
};

/// Reads the corrections of a sensor from the YAML of ROS's Velodyne driver, which its
/// gen_calibration.py makes of the db.xml that comes with a sensor: `lasers` with laser_id,
/// vert_correction, rot_correction, dist_correction, vert_offset_correction and
/// horiz_offset_correction.
/// @returns one for each of the 64 lasers
/// @throws FileError if the file cannot be read; ConfigError if it is not such a file.
std::vector<LaserCorrection> read_velodyne_calibration(const std::filesystem::path& path);

}  // namespace mms
