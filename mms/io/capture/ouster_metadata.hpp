#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

namespace mms {

/// What the data packets of an Ouster sensor do not have themselves.
struct OusterMetadata {
  std::string product;                ///< as "OS-1-64"; may be empty
  std::string profile = "LEGACY";     ///< of the packets, as "RNG19_RFL8_SIG16_NIR16"
  int pixels_per_column = 64;         ///< lasers
  int columns_per_packet = 16;        ///< measured at one time each
  int columns_per_frame = 1024;       ///< of a rotation
  std::vector<double> beam_altitude;  ///< of each pixel of a column [rad]
  std::vector<double> beam_azimuth;   ///< relative to the encoder [rad]
  Eigen::Vector2d beam_origin = Eigen::Vector2d::Zero();  ///< x and z at encoder angle 0 [m]
  Eigen::Isometry3d T_sensor_lidar = Eigen::Isometry3d::Identity();  ///< x of the sensor: forward
};

/// Reads a sensor's metadata as its software writes it, in the form before and since firmware 2.1.
/// @throws FileError if the file cannot be read; DataError if it is not such a file.
OusterMetadata read_ouster_metadata(const std::filesystem::path& path);

}  // namespace mms
