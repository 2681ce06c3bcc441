#pragma once

#include <string>
#include <string_view>

#include "mms/core/frame.hpp"
#include "mms/ros/ros_messages.hpp"

namespace mms {

/// Points of a cloud message with any layout, number type and byte order. Keeps NaN points. The
/// intensity is the field intensity, reflectivity, reflectance or i. Times of points come from the
/// field t, time, timestamp, time_offset or offset_time: seconds as floating-point numbers, or
/// nanoseconds (microseconds if a scan would take less than 2 ms); relative to the message's stamp,
/// or of its clock, or of another one (`relative_point_times`).
/// @param stamp        of the frame, reference of the times
/// @param other_clock  receives whether the times have another clock than the stamp; may be null
/// @throws DataError at `where` for a cloud without x, y and z, with too few bytes, or with fields
/// outside a point or of unknown type.
LidarScan scan_of(const msg::PointCloud2& message, Timestamp stamp, const std::string& where,
                  bool* other_clock = nullptr);

/// Points of a scan of a Livox, with the reflectivity as intensity and their times. Points without
/// return are zero.
LidarScan scan_of(const msg::LivoxScan& message);

/// Whether messages of a type, such as "livox_ros_driver/CustomMsg", are scans of a Livox.
bool is_livox_type(std::string_view type);

/// A message with x y z, and intensity and time [s] if available; all float32.
msg::PointCloud2 cloud_message(const msg::Header& header, const LidarScan& scan);

}  // namespace mms
