#include "mms/simulation/sensors/lidar_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "mms/core/hash_noise.hpp"

namespace mms {
namespace {

constexpr double kPi = std::numbers::pi;

/// Rotations per second of the two prisms of a rosette: about 120 and -80, as in Livox's Mid-40,
/// which gives 20 petals in 0.1 s; irrational offsets make the pattern non-repeating.
constexpr double kFirstPrism = 7294.0 / 60.0 + 0.01 * std::numbers::sqrt2;
constexpr double kSecondPrism = -4664.0 / 60.0 + 0.01 * std::numbers::sqrt3;

constexpr float kReference = 0.8F;   // reflectance for which data sheets specify the range
constexpr float kMinCosine = 0.02F;  // no return at a smaller cosine

Eigen::Vector3f direction_at(double azimuth, double elevation) {
  return Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                         std::cos(elevation) * std::sin(azimuth), std::sin(elevation))
      .cast<float>();
}

/// Largest float below `period`: the bound of time offsets.
float last_offset(double period) {
  const auto bound = static_cast<float>(period);
  return static_cast<double>(bound) < period ? bound : std::nextafter(bound, 0.0F);
}

std::vector<Beam> turn(const LidarSensor& sensor, int index, double period) {
  const float last = last_offset(period);
  const int gaps = std::max(sensor.rings - 1, 1);
  const double spacing = (sensor.elevation_max - sensor.elevation_min) / gaps;
  const auto phase = static_cast<double>(uniform_of(hash_of(static_cast<std::uint64_t>(index))));
  std::vector<Beam> shots;
  shots.reserve(static_cast<std::size_t>(sensor.columns) * static_cast<std::size_t>(sensor.rings));
  for (int column = 0; column < sensor.columns; ++column) {
    const double share = (column + phase) / sensor.columns;
    const float time = std::min(static_cast<float>(share * period), last);
    for (int ring = 0; ring < sensor.rings; ++ring) {
      const double elevation = sensor.elevation_max - ring * spacing;
      shots.push_back({direction_at(kPi * (1.0 - 2.0 * share), elevation), time});
    }
  }
  return shots;
}

/// Sum of the deflections of two equal prisms: r = field * |cos(half the angle between them)|.
Eigen::Vector3f rosette_at(double field, double time) {
  const auto angle = [&](double turns) { return 2.0 * kPi * (turns - std::floor(turns)); };
  const double first = angle(kFirstPrism * time);
  const double second = angle(kSecondPrism * time);
  const double y = 0.5 * field * (std::cos(first) + std::cos(second));
  const double z = 0.5 * field * (std::sin(first) + std::sin(second));
  const double off_axis = std::hypot(y, z);
  const double scale = off_axis > 1e-9 ? std::sin(off_axis) / off_axis : 1.0;
  return Eigen::Vector3d(std::cos(off_axis), y * scale, z * scale).cast<float>();
}

std::vector<Beam> rosette(const LidarSensor& sensor, int index, double period) {
  const float last = last_offset(period);
  std::vector<Beam> shots;
  shots.reserve(static_cast<std::size_t>(sensor.points));
  for (int i = 0; i < sensor.points; ++i) {
    const double offset = period * i / sensor.points;
    shots.push_back({rosette_at(sensor.field, index * period + offset),
                     std::min(static_cast<float>(offset), last)});
  }
  return shots;
}

/// Probability that a shot returns too little light.
float loss_probability(float range, float cosine, float reflectance, float gloss, float max_range) {
  const float share = range / max_range;
  const float needed = kReference * share * share;
  const float weak = needed > 0.0F ? 1.5F - reflectance * cosine / needed : 0.0F;
  const float away = std::clamp((0.95F - cosine) * 4.0F, 0.0F, 1.0F);
  return std::max(2.0F * weak, gloss * gloss * away);
}

}  // namespace

std::vector<Beam> beams(const LidarSensor& sensor, int index, double period) {
  return sensor.pattern == LidarPattern::kSpinning ? turn(sensor, index, period)
                                                   : rosette(sensor, index, period);
}

float measured_range(float range, float cosine, float reflectance, float gloss,
                     const LidarSensor& sensor, std::uint64_t hash) {
  const auto nearest = static_cast<float>(sensor.min_range);
  const auto farthest = static_cast<float>(sensor.max_range);
  const auto in_range = [&](float r) { return r >= nearest && r <= farthest; };
  if (!in_range(range) || !(cosine >= kMinCosine) || !(reflectance > 0.0F)) return 0.0F;
  const float loss = loss_probability(range, std::min(cosine, 1.0F), reflectance,
                                      gloss > 0.0F ? gloss : 0.0F, farthest);
  if (uniform_of(hash_of(hash, 1)) < loss) return 0.0F;
  const float measured = range + static_cast<float>(sensor.noise) * normal_of(hash_of(hash, 2));
  return in_range(measured) ? measured : 0.0F;
}

}  // namespace mms
