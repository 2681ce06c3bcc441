#include "mms/io/results/occupancy_grid_io.hpp"

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/config/yaml_map.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

char grey_of(Occupancy state) {
  constexpr unsigned char kGreys[] = {205, 254, 0};  // unknown, free, occupied
  return static_cast<char>(kGreys[static_cast<std::size_t>(state)]);
}

std::string pgm_of(const Image<Occupancy>& cells) {
  if (cells.empty()) return std::string("P5\n1 1\n255\n") + grey_of(Occupancy::kUnknown);
  std::string text =
      "P5\n" + std::to_string(cells.width()) + ' ' + std::to_string(cells.height()) + "\n255\n";
  text.reserve(text.size() + cells.size());
  for (int y = cells.height() - 1; y >= 0; --y) {
    for (int x = 0; x < cells.width(); ++x) text += grey_of(cells(x, y));
  }
  return text;
}

template <class Vector>
std::string list_of(const Vector& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + format_number(value);
  return text + "]";
}

/// Gray 205 is occupancy 0.19608: above this free_thresh and therefore unknown in ROS 1 and nav2.
/// With nav2's default of 0.25 it would be free.
constexpr const char* kThresholds = "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

std::string yaml_of(const std::string& picture, const OccupancyGrid& grid) {
  const Eigen::Quaterniond q(grid.T_world_map.rotation());
  const Eigen::Vector3d origin(grid.origin.x(), grid.origin.y(), 0.0);
  return "image: \"" + picture +
         "\"\nmode: trinary\nresolution: " + format_number(grid.resolution) +
         "\norigin: " + list_of(origin) + "  # of the lower left pixel: x y [m], yaw [rad]\n" +
         "negate: 0\n" + kThresholds +
         "# The map frame (z up, x forward at the start, origin on the floor) in that of the "
         "trajectory:\n# p_world = R(quaternion) p_map + translation. Map servers ignore it.\n" +
         "T_world_map:\n  translation: " + list_of(grid.T_world_map.translation()) +
         "  # x y z [m]\n" + "  quaternion: " + list_of(q.coeffs()) + "  # x y z w\n";
}

}  // namespace

void write_occupancy_grid(const std::filesystem::path& yaml, const OccupancyGrid& grid) {
  const std::filesystem::path picture = std::filesystem::path(yaml).replace_extension(".pgm");
  write_file(picture, pgm_of(grid.cells));
  write_file(yaml, yaml_of(picture.filename().string(), grid));
}

Transform<World, Map> read_map_frame(const std::filesystem::path& yaml) {
  constexpr Range kCoordinate{-1e6, 1e6};
  YamlMap file = YamlMap::load(yaml);
  YamlMap transform = file.child("T_world_map");
  const auto numbers = [&](const char* key, std::size_t count) {
    const auto node = transform.find(key);
    if (!node || !node->IsSequence() || node->size() != count) {
      throw ConfigError(
          yaml.string(),
          std::string("has no T_world_map.") + key + " of " + std::to_string(count) + " numbers",
          "expected map.yaml of a run");
    }
    std::vector<double> values;
    for (const YAML::Node& value : *node)
      values.push_back(transform.number(value, key, kCoordinate));
    return values;
  };
  const std::vector<double> t = numbers("translation", 3);
  const std::vector<double> q = numbers("quaternion", 4);
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  if (!(rotation.norm() > 0.0)) throw ConfigError(yaml.string(), "T_world_map has no rotation");
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = rotation.normalized().toRotationMatrix();
  T.translation() = Eigen::Vector3d(t[0], t[1], t[2]);
  return Transform<World, Map>(T);
}

}  // namespace mms
