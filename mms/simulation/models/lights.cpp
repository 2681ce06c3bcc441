#include "mms/simulation/models/lights.hpp"

#include <algorithm>
#include <utility>

namespace mms {
namespace {

/// Share of light computed without shadows, because some of it is occluded.
constexpr float kUnshadowedShare = 0.5F;
constexpr float kReference2 =
    9.0F;  // squared distance at which a lamp's irradiance is its color [m^2]

}  // namespace

LocalLight light_at(const Lights& lights, const Eigen::Vector3f& point,
                    const Eigen::Vector3f& normal) {
  LocalLight light;
  std::array<float, kShadowLamps> strength{};
  const float up = 0.5F + 0.5F * normal.z();
  light.rest = lights.below + up * (lights.above - lights.below);
  for (const Lamp& lamp : lights.lamps) {
    LampLight here;
    here.to_lamp = lamp.position - point;
    const float cosine = normal.dot(here.to_lamp);
    if (cosine <= 0.0F) continue;
    const float distance2 = here.to_lamp.squaredNorm() + 0.05F;
    float strong = cosine * kReference2 / (distance2 * std::sqrt(distance2));
    here.irradiance = strong * lamp.color;
    for (std::size_t i = 0; i < kShadowLamps; ++i) {
      if (strong <= strength[i]) continue;
      std::swap(strong, strength[i]);
      std::swap(here, light.lamps[i]);
    }
    light.rest += kUnshadowedShare * here.irradiance;
  }
  return light;
}

}  // namespace mms
