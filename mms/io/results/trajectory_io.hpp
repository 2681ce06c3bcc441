#pragma once

#include <chrono>
#include <filesystem>
#include <span>

#include "mms/core/trajectory.hpp"

namespace mms {

/// Time between two poses of a KITTI pose file that comes without stamps: the scanner's 10 Hz.
inline constexpr Duration kKittiPeriod = std::chrono::milliseconds(100);

/// Reads "stamp tx ty tz qx qy qz qw" lines ([s], [m]; '#' comments), in the file's order.
/// Quaternions are normalised.
/// @throws FileError when the file cannot be read.
/// @throws DataError naming file:line for another number of columns, anything but finite numbers,
///         a zero quaternion, or a file without poses.
Trajectory read_trajectory_tum(const std::filesystem::path& path);

/// Reads lines of 12 numbers, 3x4 matrices row by row [m]. Pose i has `stamps[i]`, or
/// i * kKittiPeriod where no stamps are given.
/// @throws FileError, DataError as above, and when a matrix is no rotation or the counts differ.
Trajectory read_trajectory_kitti(const std::filesystem::path& path,
                                 std::span<const Timestamp> stamps = {});

/// Whether the first pose of a file has KITTI's 12 numbers. @throws FileError when it cannot be
/// read.
bool is_kitti_trajectory(const std::filesystem::path& path);

/// Either of the two, told apart by the number of columns. @throws FileError, DataError.
Trajectory read_trajectory(const std::filesystem::path& path);

/// Writes the TUM form: stamps with nine decimals, other numbers so that they read back the same.
/// @throws FileError when the file cannot be written.
void write_trajectory_tum(const std::filesystem::path& path, const Trajectory& trajectory);

/// Writes the KITTI form, which has no stamps. @throws FileError when it cannot be written.
void write_trajectory_kitti(const std::filesystem::path& path, const Trajectory& trajectory);

}  // namespace mms
