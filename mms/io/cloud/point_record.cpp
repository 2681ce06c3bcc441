#include "mms/io/cloud/point_record.hpp"

#include <algorithm>
#include <span>

#include "mms/core/error.hpp"
#include "mms/io/cloud/point_fields.hpp"

namespace mms {
namespace {

constexpr Channel kPosition[] = {Channel::kX, Channel::kY, Channel::kZ};
constexpr Channel kNormal[] = {Channel::kNormalX, Channel::kNormalY, Channel::kNormalZ};
constexpr Channel kColor[] = {Channel::kRed, Channel::kGreen, Channel::kBlue};

void append(PointRecord& record, std::span<const Channel> channels, ScalarType type) {
  for (const Channel channel : channels) record.push_back({channel, type});
}

auto count_of(const PointRecord& record, Channel channel) {
  return std::count_if(record.begin(), record.end(),
                       [&](const PointColumn& column) { return column.channel == channel; });
}

/// Checks that all or none of a group's channels are present.
void check_group(const PointRecord& record, std::span<const Channel> group,
                 const std::string& where, const std::string& names) {
  const auto there = std::count_if(group.begin(), group.end(),
                                   [&](Channel channel) { return count_of(record, channel) > 0; });
  if (there != 0 && there != 3) throw DataError(where, "has only some of " + names);
}

}  // namespace

std::size_t size_of(ScalarType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8, 8, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_float(ScalarType type) {
  return type == ScalarType::kFloat32 || type == ScalarType::kFloat64;
}

std::size_t stride_of(const PointRecord& record) {
  std::size_t stride = 0;
  for (const PointColumn& column : record) stride += size_of(column.type);
  return stride;
}

PointRecord record_of(const PointCloudFile& cloud, bool packed_rgb) {
  const auto has = [&](const auto& values, const std::string& name) {
    if (values.empty()) return false;
    if (values.size() == cloud.points.size()) return true;
    throw DataError("point cloud", std::to_string(cloud.points.size()) + " points and " +
                                       std::to_string(values.size()) + " " + name);
  };
  PointRecord record;
  append(record, kPosition, ScalarType::kFloat32);
  if (has(cloud.normals, "normals")) append(record, kNormal, ScalarType::kFloat32);
  if (has(cloud.colors, "colors")) {
    if (packed_rgb) {
      record.push_back({Channel::kPackedRgb, ScalarType::kFloat32});
    } else {
      append(record, kColor, ScalarType::kUint8);
    }
  }
  if (has(cloud.labels, "labels")) record.push_back({Channel::kLabel, ScalarType::kInt32});
  if (has(cloud.observations, "observations")) {
    record.push_back({Channel::kObservations, ScalarType::kInt32});
  }
  if (has(cloud.intensities, "intensities")) {
    record.push_back({Channel::kIntensity, ScalarType::kFloat32});
  }
  if (has(cloud.time_offsets, "times")) record.push_back({Channel::kTime, ScalarType::kFloat32});
  return record;
}

void find_lidar_columns(PointRecord& record, const std::vector<std::string>& names) {
  const auto find = [&](std::span<const std::string_view> known, Channel channel) {
    for (PointColumn& column : record) {
      if (column.channel == channel) column.channel = Channel::kOther;
    }
    for (const std::string_view name : known) {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end()) continue;
      record[static_cast<std::size_t>(found - names.begin())].channel = channel;
      return;
    }
  };
  find(kIntensityNames, Channel::kIntensity);
  find(kPointTimeNames, Channel::kTime);
}

void check_record(const PointRecord& record, const std::string& where) {
  for (const PointColumn& column : record) {
    if (column.channel != Channel::kOther && count_of(record, column.channel) > 1) {
      throw DataError(where, "has a duplicate property");
    }
    const bool color =
        std::find(std::begin(kColor), std::end(kColor), column.channel) != std::end(kColor);
    if (color && column.type != ScalarType::kUint8) {
      throw DataError(where, "has color properties of a type other than uchar");
    }
    if (column.channel == Channel::kPackedRgb && size_of(column.type) != 4) {
      throw DataError(where, "has packed rgb of a size other than 4 bytes");
    }
  }
  for (const Channel channel : kPosition) {
    if (count_of(record, channel) == 0) throw DataError(where, "misses x, y or z");
  }
  check_group(record, kNormal, where, "the normal's three components");
  check_group(record, kColor, where, "red green blue");
}

}  // namespace mms
