#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mms/core/motion_samples.hpp"

namespace mms {

/// Reads dead reckoning of wheels: "stamp x y z qx qy qz qw" (TUM) or "stamp x y yaw" lines ([s] or
/// [ns], [m], [rad]), separated by blanks or commas; '#' comments. Repeated stamps are left out.
/// @throws FileError if the file cannot be read; DataError with file:line for a wrong number of
/// columns, a number that is not finite, a zero quaternion, a stamp that decreases, or no line.
std::vector<WheelSample> read_wheels(const std::filesystem::path& path);

/// Reads rates of a gyroscope: "stamp wx wy wz [ax ay az]" lines ([s] or [ns], [rad/s], [m/s^2]),
/// the columns of EuRoC's imu0/data.csv; else as `read_wheels`.
std::vector<ImuSample> read_imu(const std::filesystem::path& path);

/// Inverse of `read_wheels`, without loss. @throws FileError if the file cannot be written.
void write_wheels(const std::filesystem::path& path, std::span<const WheelSample> samples);

/// Inverse of `read_imu`, without loss. @throws FileError if the file cannot be written.
void write_imu(const std::filesystem::path& path, std::span<const ImuSample> samples);

/// What makes measurements implausible, one line each: gaps of more than half a second, and rates
/// that look like degrees per second.
/// @param where  file or topic, for messages
std::vector<std::string> faults_of(const MotionSamples& samples, const std::string& where);

}  // namespace mms
