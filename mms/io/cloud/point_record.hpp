#pragma once

// Internal to io: what PLY and PCD have in common, which is all but their headers.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mms/io/cloud/point_cloud_file.hpp"

namespace mms {

/// How one scalar of a point is stored; little-endian in binary files.
enum class ScalarType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// [B]
std::size_t size_of(ScalarType type);

/// What a column of a point file means; kPackedRgb is 0x00RRGGBB in four bytes.
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
  kOther
};

/// One scalar of every point.
struct PointColumn {
  Channel channel = Channel::kOther;       ///< what it means
  ScalarType type = ScalarType::kFloat32;  ///< how it is stored
};

/// The columns of one point, in the file's order without gaps.
using PointRecord = std::vector<PointColumn>;

/// Bytes of one point in a binary file [B].
std::size_t stride_of(const PointRecord& record);

/// The columns that a cloud needs, with packed or separate colours.
/// @throws DataError when the cloud's vectors are not parallel.
PointRecord record_of(const PointCloudFile& cloud, bool packed_rgb);

/// Checks a record before its points are read: x y z there, no channel twice, colours in bytes.
/// @throws DataError at `where`.
void check_record(const PointRecord& record, const std::string& where);

/// Reads `count` points. @throws DataError at `where` when `data` is too short for them, which is
/// found before anything is allocated, or when a value does not fit its channel.
PointCloudFile decode_binary(std::string_view data, std::uint64_t count, const PointRecord& record,
                             const std::string& where);
PointCloudFile decode_ascii(std::string_view data, std::uint64_t count, const PointRecord& record,
                            const std::string& where);

/// The points' bytes, little-endian.
std::string encode_binary(const PointCloudFile& cloud, const PointRecord& record);

}  // namespace mms
