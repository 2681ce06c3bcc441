#include "mms/run/sensor_settings.hpp"

#include <utility>

#include "mms/io/config/config_assignments.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/run/record/run_record.hpp"
#include "mms/run/segmenter/network_detector.hpp"

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

SystemConfig with_options(SystemConfig config, const RunOptions& options) {
  std::string& weights = config.segmentation.weights;
  if (!options.weights.empty()) weights = options.weights;
  // The settings are kept with the results, which are viewed from other folders.
  const bool is_used = options.segmenter == "network" && !weights.empty();
  if (is_used) weights = absolute_path(weights_path(weights));
  if (options.fusion == "multimodal") config.fusion.mode = FusionMode::kMultimodal;
  if (options.fusion == "vision") config.fusion.mode = FusionMode::kVision;
  if (options.fusion == "none") config.fusion.mode = FusionMode::kNone;
  if (!options.loops.empty()) config.global_map.enabled = options.loops == "on";
  return config;
}

}  // namespace mms
