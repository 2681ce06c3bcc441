#pragma once

// Internal to io: the common part of PLY and PCD, without headers.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mms/io/cloud/point_cloud_file.hpp"

namespace mms {

/// How one scalar of a point is stored; little-endian in binary files.
enum class ScalarType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64,
  kInt64,
  kUint64
};

/// [B]
std::size_t size_of(ScalarType type);

/// Whether values are stored as floating-point numbers.
bool is_float(ScalarType type);

/// Meaning of a column of a point file; kPackedRgb is 0x00RRGGBB in four bytes.
enum class Channel {
  kX,
  kY,
  kZ,
  kNormalX,
  kNormalY,
  kNormalZ,
  kRed,
  kGreen,
  kBlue,
  kPackedRgb,
  kLabel,
  kObservations,
  kIntensity,
  kTime,
  kOther
};

/// One scalar per point.
struct PointColumn {
  Channel channel = Channel::kOther;       ///< what it means
  ScalarType type = ScalarType::kFloat32;  ///< how it is stored
};

/// The columns of a point in file order, without padding.
using PointRecord = std::vector<PointColumn>;

/// Bytes of one point in a binary file [B].
std::size_t stride_of(const PointRecord& record);

/// The columns for a cloud, with packed or separate colors.
/// @throws DataError if the cloud's vectors differ in size.
PointRecord record_of(const PointCloudFile& cloud, bool packed_rgb);

/// Gives the columns of intensity and time, which have many names, their channels.
/// @param names  of the columns
void find_lidar_columns(PointRecord& record, const std::vector<std::string>& names);

/// Checks that x y z are present, that no channel appears twice and that colors are bytes.
/// @throws DataError at `where`.
void check_record(const PointRecord& record, const std::string& where);

/// Decodes `count` points.
/// @throws DataError at `where` if `data` is too short, which is checked before allocation, or if a
/// value does not fit its channel.
PointCloudFile decode_binary(std::string_view data, std::uint64_t count, const PointRecord& record,
                             const std::string& where);
PointCloudFile decode_ascii(std::string_view data, std::uint64_t count, const PointRecord& record,
                            const std::string& where);

/// Encodes the points, little-endian.
std::string encode_binary(const PointCloudFile& cloud, const PointRecord& record);

}  // namespace mms
