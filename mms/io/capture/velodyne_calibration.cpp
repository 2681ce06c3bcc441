#include "mms/io/capture/velodyne_calibration.hpp"

#include <string>

#include "mms/core/error.hpp"
#include "mms/io/config/yaml_map.hpp"

namespace mms {
namespace {

constexpr std::size_t kHdl64Lasers = 64;

}  // namespace

std::vector<LaserCorrection> read_velodyne_calibration(const std::filesystem::path& path) {
  YamlMap file = YamlMap::load(path);
  auto lasers = file.children("lasers");
  if (!lasers || lasers->size() != kHdl64Lasers) {
    throw ConfigError(path.string(), "has not the 64 lasers of an HDL-64E",
                      "expected the calibration of ROS's Velodyne driver");
  }
  std::vector<LaserCorrection> corrections(kHdl64Lasers);
  for (YamlMap& laser : *lasers) {
    const auto number = [&](const char* key) {
      const auto node = laser.find(key);
      if (!node) throw ConfigError(path.string(), std::string("a laser has no '") + key + "'");
      return laser.number(*node, key, {});
    };
    const auto id = laser.find("laser_id");
    if (!id) throw ConfigError(path.string(), "a laser has no 'laser_id'");
    const int index = laser.integer(*id, "laser_id", {0, kHdl64Lasers - 1});
    corrections[static_cast<std::size_t>(index)] = {
        number("vert_correction"), number("rot_correction"), number("dist_correction"),
        number("vert_offset_correction"), number("horiz_offset_correction")};
  }
  return corrections;
}

}  // namespace mms
