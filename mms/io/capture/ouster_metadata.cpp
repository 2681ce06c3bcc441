#include "mms/io/capture/ouster_metadata.hpp"

#include <numbers>
#include <optional>

#include "mms/io/config/json_entry.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/pose_text.hpp"

namespace mms {
namespace {

constexpr double kMillimeter = 1e-3;

/// Keys are in groups since firmware 2.1, before at the top.
constexpr const char* kGroups[] = {"beam_intrinsics", "lidar_intrinsics", "lidar_data_format",
                                   "data_format",     "config_params",    "sensor_info"};

std::optional<JsonEntry> find_key(const JsonEntry& file, const std::string& key) {
  if (file.has(key)) return file.at(key);
  for (const char* group : kGroups) {
    if (!file.has(group)) continue;
    const JsonEntry entry = file.at(group);
    if (entry.is_object() && entry.has(key)) return entry.at(key);
  }
  return std::nullopt;
}

JsonEntry need_key(const JsonEntry& file, const std::string& key) {
  if (auto entry = find_key(file, key)) return *entry;
  file.fail("has no '" + key + "'", "expected the metadata of an Ouster sensor");
}

std::vector<double> numbers_of(const JsonEntry& list) {
  std::vector<double> numbers;
  for (const JsonEntry& element : list.elements()) numbers.push_back(element.number());
  return numbers;
}

/// A 4x4 matrix in mm as a transform in m.
Eigen::Isometry3d transform_of(const JsonEntry& entry) {
  std::vector<double> rows = numbers_of(entry);
  for (const std::size_t i : {3U, 7U, 11U}) {
    if (i < rows.size()) rows[i] *= kMillimeter;
  }
  return isometry_from_rows(rows, "lidar_to_sensor_transform");
}

std::vector<double> angles_of(const JsonEntry& list, int count) {
  std::vector<double> angles = numbers_of(list);
  if (angles.size() != static_cast<std::size_t>(count)) {
    list.fail("has " + std::to_string(angles.size()) + " angles, expected " +
              std::to_string(count));
  }
  for (double& angle : angles) angle *= std::numbers::pi / 180.0;
  return angles;
}

int columns_of_mode(const JsonEntry& mode) {
  const std::string text = mode.text();  // as "1024x10"
  const auto columns = parse_integer(std::string_view(text).substr(0, text.find('x')));
  if (columns && *columns >= 1 && *columns <= 4096) return static_cast<int>(*columns);
  mode.fail("is '" + text + "'", "expected as 1024x10");
}

}  // namespace

OusterMetadata read_ouster_metadata(const std::filesystem::path& path) {
  constexpr Range kPixels{1, 256};
  constexpr Range kColumns{1, 4096};
  const auto json = parse_json(path);
  const JsonEntry file(json, path.string());
  OusterMetadata metadata;
  const auto integer = [&](const char* key, Range range, int& value) {
    const auto entry = find_key(file, key);
    if (entry) value = static_cast<int>(entry->integer(range));
    return entry.has_value();
  };
  if (const auto entry = find_key(file, "prod_line")) metadata.product = entry->text();
  if (const auto entry = find_key(file, "udp_profile_lidar")) metadata.profile = entry->text();
  integer("pixels_per_column", kPixels, metadata.pixels_per_column);
  integer("columns_per_packet", kColumns, metadata.columns_per_packet);
  if (!integer("columns_per_frame", kColumns, metadata.columns_per_frame)) {
    metadata.columns_per_frame = columns_of_mode(need_key(file, "lidar_mode"));
  }
  metadata.beam_altitude =
      angles_of(need_key(file, "beam_altitude_angles"), metadata.pixels_per_column);
  metadata.beam_azimuth =
      angles_of(need_key(file, "beam_azimuth_angles"), metadata.pixels_per_column);
  if (const auto entry = find_key(file, "beam_to_lidar_transform")) {
    const Eigen::Vector3d origin = transform_of(*entry).translation();
    metadata.beam_origin = {origin.x(), origin.z()};
  } else if (const auto offset = find_key(file, "lidar_origin_to_beam_origin_mm")) {
    metadata.beam_origin.x() = kMillimeter * offset->number();
  }
  if (const auto entry = find_key(file, "lidar_to_sensor_transform")) {
    metadata.T_sensor_lidar = transform_of(*entry);
  }
  return metadata;
}

}  // namespace mms
