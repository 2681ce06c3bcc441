#pragma once

#include <chrono>
#include <filesystem>
#include <span>

#include "mms/core/trajectory.hpp"

namespace mms {

/// Period of a KITTI pose file without stamps: the scanner's 10 Hz.
inline constexpr Duration kKittiPeriod = std::chrono::milliseconds(100);

/// Reads "stamp tx ty tz qx qy qz qw" lines ([s], [m]; '#' comments) in file order. Normalizes
/// quaternions.
/// @throws FileError if the file cannot be read.
/// @throws DataError with file:line for a wrong number of columns, a non-finite number, a zero
/// quaternion, or a file without poses.
Trajectory read_trajectory_tum(const std::filesystem::path& path);

/// Reads lines of 12 numbers: 3x4 matrices, row-major [m]. Pose i has `stamps[i]`, or i *
/// kKittiPeriod without stamps.
/// @throws FileError, DataError as above, and if a matrix is not a rotation or the counts differ.
Trajectory read_trajectory_kitti(const std::filesystem::path& path,
                                 std::span<const Timestamp> stamps = {});

/// Whether the first pose of a file has KITTI's 12 numbers.
/// @throws FileError if it cannot be read.
bool is_kitti_trajectory(const std::filesystem::path& path);

/// Reads either format, chosen by the number of columns.
/// @throws FileError, DataError.
Trajectory read_trajectory(const std::filesystem::path& path);

/// Writes the TUM format: stamps with nine decimals, other numbers without loss.
/// @throws FileError if the file cannot be written.
void write_trajectory_tum(const std::filesystem::path& path, const Trajectory& trajectory);

/// Writes the KITTI format, which has no stamps.
/// @throws FileError if it cannot be written.
void write_trajectory_kitti(const std::filesystem::path& path, const Trajectory& trajectory);

/// File of the trajectory in the frame of the maps of a result folder: trajectory_map.tum,
/// corrected by loop closure, or trajectory.tum where there is none.
std::filesystem::path map_trajectory_file(const std::filesystem::path& folder);

}  // namespace mms
