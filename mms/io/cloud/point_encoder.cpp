#include <bit>
#include <cstring>

#include "mms/io/cloud/point_record.hpp"

namespace mms {
namespace {

static_assert(std::endian::native == std::endian::little, "values are copied bytewise");

std::uint32_t pack(Rgb color) {
  return static_cast<std::uint32_t>(color.r << 16 | color.g << 8 | color.b);
}

template <class T>
void put(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

void put(std::string& bytes, const PointCloudFile& cloud, std::size_t i, Channel channel) {
  switch (channel) {
    case Channel::kX:
      return put(bytes, cloud.points[i].x());
    case Channel::kY:
      return put(bytes, cloud.points[i].y());
    case Channel::kZ:
      return put(bytes, cloud.points[i].z());
    case Channel::kNormalX:
      return put(bytes, cloud.normals[i].x());
    case Channel::kNormalY:
      return put(bytes, cloud.normals[i].y());
    case Channel::kNormalZ:
      return put(bytes, cloud.normals[i].z());
    case Channel::kRed:
      return put(bytes, cloud.colors[i].r);
    case Channel::kGreen:
      return put(bytes, cloud.colors[i].g);
    case Channel::kBlue:
      return put(bytes, cloud.colors[i].b);
    case Channel::kPackedRgb:
      return put(bytes, pack(cloud.colors[i]));
    case Channel::kLabel:
      return put(bytes, cloud.labels[i]);
    case Channel::kObservations:
      return put(bytes, cloud.observations[i]);
    case Channel::kIntensity:
      return put(bytes, cloud.intensities[i]);
    case Channel::kTime:
      return put(bytes, cloud.time_offsets[i]);
    case Channel::kOther:
      return;
  }
}

}  // namespace

std::string encode_binary(const PointCloudFile& cloud, const PointRecord& record) {
  std::string bytes;
  bytes.reserve(cloud.points.size() * stride_of(record));
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (const PointColumn& column : record) put(bytes, cloud, i, column.channel);
  }
  return bytes;
}

}  // namespace mms
