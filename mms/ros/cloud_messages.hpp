#pragma once

#include <string>

#include "mms/core/frame.hpp"
#include "mms/ros/messages.hpp"

namespace mms {

/// The points of a cloud message of any layout, number type and byte order. Points that are NaN
/// stay. The intensity is that of the field intensity, reflectivity, reflectance or i. Times of the
/// points are taken from the field t, time, timestamp, time_offset or offset_time: seconds as a
/// floating point number, or nanoseconds (microseconds where a scan took less than 2 ms of those);
/// counted from the message's stamp, or from 1970 as the stamp is.
/// @param stamp  of the frame, which times count from
/// @throws DataError at `where` for a cloud without x, y and z, one that is smaller than its header
///         says, and fields that lie outside a point or are of an unknown type.
LidarScan scan_of(const msg::PointCloud2& message, Timestamp stamp, const std::string& where);

/// A message with x y z, and intensity and time [s] where there are such; all float32.
msg::PointCloud2 cloud_message(const msg::Header& header, const LidarScan& scan);

}  // namespace mms
