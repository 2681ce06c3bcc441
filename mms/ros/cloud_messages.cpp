#include "mms/ros/cloud_messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/io/cloud/point_fields.hpp"

namespace mms {
namespace {

constexpr std::uint8_t kFloat32 = 7;

/// Bytes of the types of sensor_msgs/PointField; 0 for unknown ones.
std::size_t size_of(std::uint8_t datatype) {
  constexpr std::size_t kSizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return datatype < std::size(kSizes) ? kSizes[datatype] : 0;
}

/// One field of all points of a cloud, of any number type.
class Column {
 public:
  Column(const msg::PointCloud2& cloud, const msg::PointField& field, const std::string& where)
      : cloud_(&cloud), field_(&field), size_(size_of(field.datatype)) {
    if (size_ == 0) {
      throw DataError(where, "its field '" + field.name + "' has the unknown type " +
                                 std::to_string(field.datatype));
    }
    if (field.offset + size_ <= cloud.point_step) return;
    throw DataError(where, "its field '" + field.name + "' ends at byte " +
                               std::to_string(field.offset + size_) + " of points with " +
                               std::to_string(cloud.point_step));
  }

  bool is_integer() const { return field_->datatype < kFloat32; }

  double operator()(std::size_t row, std::size_t column) const {
    const std::size_t at = row * cloud_->row_step + column * cloud_->point_step + field_->offset;
    const std::uint8_t* raw = cloud_->data.data() + at;
    switch (field_->datatype) {
      case 1:
        return number<std::int8_t>(raw);
      case 2:
        return number<std::uint8_t>(raw);
      case 3:
        return number<std::int16_t>(raw);
      case 4:
        return number<std::uint16_t>(raw);
      case 5:
        return number<std::int32_t>(raw);
      case 6:
        return number<std::uint32_t>(raw);
      case kFloat32:
        return number<float>(raw);
      default:
        return number<double>(raw);
    }
  }

 private:
  template <class T>
  double number(const std::uint8_t* raw) const {
    std::array<std::uint8_t, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), raw, sizeof(T));
    if (cloud_->is_bigendian) std::reverse(bytes.begin(), bytes.end());
    return static_cast<double>(std::bit_cast<T>(bytes));
  }

  const msg::PointCloud2* cloud_;
  const msg::PointField* field_;
  std::size_t size_;
};

std::optional<Column> find_column(const msg::PointCloud2& cloud,
                                  std::span<const std::string_view> names,
                                  const std::string& where) {
  for (const std::string_view name : names) {
    for (const msg::PointField& field : cloud.point_fields) {
      if (field.name == name) return Column(cloud, field, where);
    }
  }
  return std::nullopt;
}

Column coordinate(const msg::PointCloud2& cloud, std::string_view name, const std::string& where) {
  if (const auto column = find_column(cloud, {&name, 1}, where)) return *column;
  std::string found;
  for (const msg::PointField& field : cloud.point_fields) {
    found += (found.empty() ? "" : ", ") + field.name;
  }
  throw DataError(where, "has no field '" + std::string(name) + "'",
                  found.empty() ? "it has no fields" : "it has " + found);
}

void check_size(const msg::PointCloud2& cloud, const std::string& where) {
  const std::size_t row = std::size_t{cloud.width} * cloud.point_step;
  const bool rows = cloud.height <= 1 || cloud.row_step >= row;
  const std::size_t required =
      cloud.height == 0 ? 0 : (cloud.height - std::size_t{1}) * cloud.row_step + row;
  if (rows && cloud.data.size() >= required) return;
  throw DataError(where, "has " + std::to_string(cloud.data.size()) + " bytes for " +
                             size_text(cloud.width, cloud.height) + " points of " +
                             std::to_string(cloud.point_step));
}

/// Calls `visit(row, column)` for every point in order.
template <class Visit>
void for_points(const msg::PointCloud2& cloud, const Visit& visit) {
  for (std::size_t row = 0; row < cloud.height; ++row) {
    for (std::size_t column = 0; column < cloud.width; ++column) visit(row, column);
  }
}

void add_float_field(msg::PointCloud2& message, const char* name) {
  message.point_fields.push_back({name, message.point_step, kFloat32, 1});
  message.point_step += sizeof(float);
}

}  // namespace

LidarScan scan_of(const msg::PointCloud2& message, Timestamp stamp, const std::string& where,
                  bool* other_clock) {
  const Column x = coordinate(message, "x", where);
  const Column y = coordinate(message, "y", where);
  const Column z = coordinate(message, "z", where);
  check_size(message, where);
  const std::size_t count = std::size_t{message.width} * message.height;
  LidarScan scan;
  if (count == 0) return scan;
  scan.points.reserve(count);
  for_points(message, [&](std::size_t row, std::size_t column) {
    scan.points.push_back(
        Eigen::Vector3d(x(row, column), y(row, column), z(row, column)).cast<float>());
  });
  if (const auto intensity = find_column(message, kIntensityNames, where)) {
    scan.intensity.reserve(count);
    for_points(message, [&](std::size_t row, std::size_t column) {
      scan.intensity.push_back(static_cast<float>((*intensity)(row, column)));
    });
  }
  if (const auto time = find_column(message, kPointTimeNames, where)) {
    std::vector<double> times;
    times.reserve(count);
    for_points(message,
               [&](std::size_t row, std::size_t column) { times.push_back((*time)(row, column)); });
    PointTimes relative = relative_point_times(times, time->is_integer(), stamp);
    scan.time_offset = std::move(relative.offsets);
    if (other_clock != nullptr) *other_clock = relative.other_clock;
  }
  return scan;
}

LidarScan scan_of(const msg::LivoxScan& message) {
  LidarScan scan;
  for (const msg::LivoxPoint& point : message.points) {
    scan.points.emplace_back(point.position[0], point.position[1], point.position[2]);
    scan.intensity.push_back(static_cast<float>(point.reflectivity));
    scan.time_offset.push_back(static_cast<float>(1e-9 * point.offset_time));
  }
  return scan;
}

bool is_livox_type(std::string_view type) {
  return type == "livox_ros_driver/CustomMsg" || type == "livox_ros_driver2/CustomMsg" ||
         type == "livox_interfaces/CustomMsg";
}

msg::PointCloud2 cloud_message(const msg::Header& header, const LidarScan& scan) {
  msg::PointCloud2 message;
  message.header = header;
  message.height = 1;
  message.width = static_cast<std::uint32_t>(scan.points.size());
  for (const char* name : {"x", "y", "z"}) add_float_field(message, name);
  if (!scan.intensity.empty()) add_float_field(message, "intensity");
  if (!scan.time_offset.empty()) add_float_field(message, "time");
  message.row_step = message.point_step * message.width;
  message.data.resize(message.row_step);
  std::uint8_t* next = message.data.data();
  const auto put = [&next](float value) {
    std::memcpy(next, &value, sizeof value);
    next += sizeof value;
  };
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    for (const float value : scan.points[i]) put(value);
    if (!scan.intensity.empty()) put(scan.intensity[i]);
    if (!scan.time_offset.empty()) put(scan.time_offset[i]);
  }
  return message;
}

}  // namespace mms
