#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "mms/core/error.hpp"
#include "mms/io/cloud/point_fields.hpp"
#include "mms/io/cloud/point_record.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

static_assert(std::endian::native == std::endian::little, "records are copied bytewise");

template <class T>
double load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double load(const char* bytes, ScalarType type) {
  switch (type) {
    case ScalarType::kInt8:
      return load<std::int8_t>(bytes);
    case ScalarType::kUint8:
      return load<std::uint8_t>(bytes);
    case ScalarType::kInt16:
      return load<std::int16_t>(bytes);
    case ScalarType::kUint16:
      return load<std::uint16_t>(bytes);
    case ScalarType::kInt32:
      return load<std::int32_t>(bytes);
    case ScalarType::kUint32:
      return load<std::uint32_t>(bytes);
    case ScalarType::kFloat32:
      return load<float>(bytes);
    case ScalarType::kFloat64:
      return load<double>(bytes);
    case ScalarType::kInt64:
      return load<std::int64_t>(bytes);
    case ScalarType::kUint64:
      return load<std::uint64_t>(bytes);
  }
  return 0.0;
}

template <class Integer>
Integer whole(double value, const std::string& where) {
  constexpr double kMin = std::numeric_limits<Integer>::min();
  constexpr double kMax = std::numeric_limits<Integer>::max();
  if (value >= kMin && value <= kMax) return static_cast<Integer>(value);
  throw DataError(where, "a point has the value " + format_number(value) +
                             ", allowed: " + format_number(kMin) + " to " + format_number(kMax));
}

/// Coordinates beyond the range of float become infinite, which means no return.
float coordinate(double value) {
  if (std::abs(value) <= std::numeric_limits<float>::max()) return static_cast<float>(value);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return static_cast<float>(std::isnan(value) ? value : std::copysign(kInfinity, value));
}

Rgb unpack(std::uint32_t packed) {
  return {static_cast<std::uint8_t>(packed >> 16), static_cast<std::uint8_t>(packed >> 8),
          static_cast<std::uint8_t>(packed)};
}

/// Sizes the cloud's vectors and sets their values.
class CloudBuilder {
 public:
  CloudBuilder(std::uint64_t count, const PointRecord& record, std::string where)
      : where_(std::move(where)) {
    cloud_.points.resize(count);
    for (const PointColumn& column : record) resize(column, count);
  }

  void set(std::size_t i, Channel channel, double value) {
    switch (channel) {
      case Channel::kX:
        cloud_.points[i].x() = coordinate(value);
        break;
      case Channel::kY:
        cloud_.points[i].y() = coordinate(value);
        break;
      case Channel::kZ:
        cloud_.points[i].z() = coordinate(value);
        break;
      case Channel::kNormalX:
        cloud_.normals[i].x() = coordinate(value);
        break;
      case Channel::kNormalY:
        cloud_.normals[i].y() = coordinate(value);
        break;
      case Channel::kNormalZ:
        cloud_.normals[i].z() = coordinate(value);
        break;
      case Channel::kRed:
        cloud_.colors[i].r = whole<std::uint8_t>(value, where_);
        break;
      case Channel::kGreen:
        cloud_.colors[i].g = whole<std::uint8_t>(value, where_);
        break;
      case Channel::kBlue:
        cloud_.colors[i].b = whole<std::uint8_t>(value, where_);
        break;
      case Channel::kLabel:
        cloud_.labels[i] = whole<std::int32_t>(value, where_);
        break;
      case Channel::kObservations:
        cloud_.observations[i] = whole<std::int32_t>(value, where_);
        break;
      case Channel::kIntensity:
        cloud_.intensities[i] = coordinate(value);
        break;
      case Channel::kTime:
        times_[i] = value;
        break;
      case Channel::kPackedRgb:
      case Channel::kOther:
        break;
    }
  }

  void set_packed(std::size_t i, std::uint32_t packed) { cloud_.colors[i] = unpack(packed); }

  PointCloudFile take() {
    cloud_.time_offsets = relative_point_times(times_, integer_times_, std::nullopt).offsets;
    return std::move(cloud_);
  }

 private:
  void resize(const PointColumn& column, std::uint64_t count) {
    const Channel channel = column.channel;
    if (channel == Channel::kNormalX) cloud_.normals.resize(count);
    if (channel == Channel::kRed || channel == Channel::kPackedRgb) cloud_.colors.resize(count);
    if (channel == Channel::kLabel) cloud_.labels.resize(count);
    if (channel == Channel::kObservations) cloud_.observations.resize(count);
    if (channel == Channel::kIntensity) cloud_.intensities.resize(count);
    if (channel != Channel::kTime) return;
    times_.resize(count);
    integer_times_ = !is_float(column.type);
  }

  PointCloudFile cloud_;
  std::vector<double> times_;  ///< as stored
  bool integer_times_ = false;
  std::string where_;
};

/// Removes the next word from the front of `text`; empty at its end.
std::string_view take_word(std::string_view& text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

double parse_value(std::string_view word, std::size_t point, const std::string& where) {
  if (const auto value = parse_double(word)) return *value;
  throw DataError(where, word.empty() ? "ends before point " + std::to_string(point)
                                      : "'" + std::string(word) + "' at point " +
                                            std::to_string(point) + " is not a number");
}

}  // namespace

PointCloudFile decode_binary(std::string_view data, std::uint64_t count, const PointRecord& record,
                             const std::string& where) {
  const std::size_t stride = stride_of(record);
  if (count > data.size() / stride) {
    throw DataError(where,
                    "promises " + std::to_string(count) + " points, but has only the bytes of " +
                        std::to_string(data.size() / stride),
                    "the file may be truncated");
  }
  CloudBuilder builder(count, record, where);
  const char* bytes = data.data();
  for (std::size_t i = 0; i < count; ++i) {
    for (const PointColumn& column : record) {
      if (column.channel == Channel::kPackedRgb) {
        std::uint32_t packed = 0;
        std::memcpy(&packed, bytes, sizeof packed);
        builder.set_packed(i, packed);
      } else {
        builder.set(i, column.channel, load(bytes, column.type));
      }
      bytes += size_of(column.type);
    }
  }
  return builder.take();
}

PointCloudFile decode_ascii(std::string_view data, std::uint64_t count, const PointRecord& record,
                            const std::string& where) {
  // A value needs at least one character and one blank.
  const std::uint64_t most = (data.size() + 1) / (2 * record.size());
  if (count > most) {
    throw DataError(where,
                    "promises " + std::to_string(count) + " points, but has space for at most " +
                        std::to_string(most),
                    "the file may be truncated");
  }
  CloudBuilder builder(count, record, where);
  for (std::size_t i = 0; i < count; ++i) {
    for (const PointColumn& column : record) {
      const double value = parse_value(take_word(data), i, where);
      if (column.channel != Channel::kPackedRgb) {
        builder.set(i, column.channel, value);
      } else if (column.type == ScalarType::kFloat32) {
        builder.set_packed(i, std::bit_cast<std::uint32_t>(coordinate(value)));
      } else {
        builder.set_packed(i, whole<std::uint32_t>(value, where));
      }
    }
  }
  return builder.take();
}

}  // namespace mms
