#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace mms {

/// A lamp under the ceiling, small enough to cast sharp shadows.
struct Lamp {
  Eigen::Vector3f position;                 ///< [m]
  Eigen::Vector3f color{1.0F, 1.0F, 1.0F};  ///< irradiance it gives 3 m away, straight on
};

/// All light of a scene: lamps, and what walls and ceiling scatter.
struct Lights {
  std::vector<Lamp> lamps;
  Eigen::Vector3f above{0.25F, 0.26F, 0.28F};  ///< scattered light on what faces up
  Eigen::Vector3f below{0.12F, 0.11F, 0.10F};  ///< ... and down
};

/// How many lamps are computed exactly, with shadows, at one point.
inline constexpr std::size_t kShadowLamps = 2;

/// One lamp's light at a point.
struct LampLight {
  Eigen::Vector3f to_lamp{0.0F, 0.0F, 0.0F};     ///< from the point to the lamp [m]
  Eigen::Vector3f irradiance{0.0F, 0.0F, 0.0F};  ///< if nothing is in between
};

/// Light at one point: of the strongest lamps one by one, of all others and the surroundings as a
/// sum without shadows.
struct LocalLight {
  std::array<LampLight, kShadowLamps> lamps;
  Eigen::Vector3f rest{0.0F, 0.0F, 0.0F};
};

LocalLight light_at(const Lights& lights, const Eigen::Vector3f& point,
                    const Eigen::Vector3f& normal);

}  // namespace mms
