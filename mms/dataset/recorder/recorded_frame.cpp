#include "mms/dataset/recorder/recorded_frame.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "mms/io/image/image_io.hpp"
#include "mms/simulation/sensors/mask_errors.hpp"

namespace mms {
namespace {

std::vector<ObjectClass> classes_of(const std::vector<ObjectTruth>& objects) {
  std::vector<ObjectClass> classes;
  for (const ObjectTruth& object : objects) {
    const auto id = static_cast<std::size_t>(object.id);
    if (classes.size() <= id) classes.resize(id + 1);
    classes[id] = object.object_class;
  }
  return classes;
}

Image<float> in_metres(const Image<std::uint16_t>& raw, double depth_scale) {
  Image<float> depth(raw.width(), raw.height());
  const auto units = static_cast<float>(depth_scale);
  for (std::size_t i = 0; i < raw.size(); ++i) depth[i] = static_cast<float>(raw[i]) / units;
  return depth;
}

}  // namespace

std::vector<std::uint8_t> recorded_color(const Frame& frame, const SensorPreset& sensor) {
  return encode_jpeg(frame.color, sensor.color.jpeg_quality);
}

Image<std::uint16_t> recorded_depth(const Image<float>& depth, double depth_scale) {
  constexpr double kMax = std::numeric_limits<std::uint16_t>::max();
  Image<std::uint16_t> raw(depth.width(), depth.height());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const double units = std::round(depth[i] * depth_scale);
    raw[i] = units > 0.0 && units <= kMax ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
  }
  return raw;
}

Image<std::uint8_t> recorded_mask(const SimulatedFrame& frame, const SceneConfig& config) {
  if (!config.mask_errors.enabled) return frame.frame.mask;
  return imperfect_masks(frame.exact.object, classes_of(frame.objects), config.mask_errors,
                         static_cast<std::uint64_t>(config.seed),
                         static_cast<int>(frame.frame.index));
}

std::string recorded_name(const Frame& frame, const SensorPreset& sensor) {
  if (!sensor.lidar) return frame.stamp.to_string();
  char text[32];
  std::snprintf(text, sizeof text, "%06lld", static_cast<long long>(frame.index));
  return text;
}

Calibration recorded_calibration(const Calibration& exact, const SensorPreset& sensor) {
  Calibration calibration = exact;
  calibration.depth_scale = sensor.depth_scale;
  if (sensor.depth) calibration.max_depth = sensor.depth->max_range;
  return calibration;
}

Frame as_recorded(const SimulatedFrame& simulated, const SceneConfig& config,
                  const SensorPreset& sensor) {
  Frame frame = simulated.frame;
  frame.name = recorded_name(frame, sensor);
  frame.calibration = std::make_shared<const Calibration>(
      recorded_calibration(*simulated.frame.calibration, sensor));
  frame.mask = recorded_mask(simulated, config);
  if (!frame.color.empty()) frame.color = decode_color(recorded_color(frame, sensor), frame.name);
  if (frame.has_depth()) {
    frame.depth = in_metres(recorded_depth(frame.depth, sensor.depth_scale), sensor.depth_scale);
  }
  return frame;
}

}  // namespace mms
