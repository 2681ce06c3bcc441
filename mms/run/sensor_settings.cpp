#include "mms/run/sensor_settings.hpp"

#include <utility>

#include "mms/io/config/config_assignments.hpp"
#include "mms/io/config/config_yaml.hpp"

namespace mms {

SystemConfig sensor_settings(const Calibration* calibration, const std::filesystem::path& file,
                             std::span<const std::string> assignments, const std::string& where,
                             std::vector<std::string>& warnings) {
  SystemConfig config;
  if (calibration != nullptr && calibration->max_depth) {
    config.static_map.surface.max_depth = *calibration->max_depth;
  }
  if (!file.empty()) warnings = load_config(file, config);
  for (std::string& warning : assign(config, assignments, where)) {
    warnings.push_back(std::move(warning));
  }
  return config;
}

}  // namespace mms
