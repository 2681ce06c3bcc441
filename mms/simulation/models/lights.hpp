#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace mms {

/// A lamp under the ceiling, small enough to cast sharp shadows.
struct Lamp {
  Eigen::Vector3f position;                 ///< [m]
  Eigen::Vector3f color{1.0F, 1.0F, 1.0F};  ///< irradiance at 3 m, perpendicular
};

/// All light of a scene: lamps, and ambient light of walls and ceiling.
struct Lights {
  std::vector<Lamp> lamps;
  Eigen::Vector3f above{0.25F, 0.26F, 0.28F};  ///< ambient light on surfaces that face up
  Eigen::Vector3f below{0.12F, 0.11F, 0.10F};  ///< and down
};

/// Number of lamps computed with shadows at one point.
inline constexpr std::size_t kShadowLamps = 2;

/// One lamp's light at a point.
struct LampLight {
  Eigen::Vector3f to_lamp{0.0F, 0.0F, 0.0F};     ///< from the point to the lamp [m]
  Eigen::Vector3f irradiance{0.0F, 0.0F, 0.0F};  ///< without occlusion
};

/// Light at one point: the strongest lamps separately, all others and ambient light as a sum
/// without shadows.
struct LocalLight {
  std::array<LampLight, kShadowLamps> lamps;
  Eigen::Vector3f rest{0.0F, 0.0F, 0.0F};
};

LocalLight light_at(const Lights& lights, const Eigen::Vector3f& point,
                    const Eigen::Vector3f& normal);

}  // namespace mms
