#pragma once

#include <cstdint>

#include "mms/simulation/vehicles/agv_assembly.hpp"

namespace mms {

/// Colors and random choices of one vehicle.
class AgvStyle {
 public:
  explicit AgvStyle(std::uint64_t seed);

  /// Uniform between `low` and `high`; independent for every `what`.
  float between(std::uint64_t what, float low, float high) const;

  /// True for `share` of all seeds.
  bool chance(std::uint64_t what, float share) const;

  /// Sine of time with a period of about `period` [s]; its phase depends on `what`.
  float wave(std::uint64_t what, float period, double seconds) const;

  /// Joint at `T` that rotates about `axis` by `center` +- `amplitude` [rad], as wave().
  AgvAssembly::Joint swing(std::uint64_t what, float period, const Eigen::Vector3f& axis,
                           float center, float amplitude, const Eigen::Isometry3f& T) const;

  Material paint() const;  ///< of the body
  Material trim() const;   ///< of attached parts
  Material dark() const;   ///< frames, bumpers, housings
  Material rubber() const;
  Material steel() const;
  Material hazard() const;
  Material sticker() const;
  Material glow(const Eigen::Vector3f& color) const;  ///< lamps and lenses
  Material cardboard(std::uint32_t number) const;
  Material wood() const;

 private:
  std::uint64_t seed_;
  Eigen::Vector3f color_;
  Eigen::Vector3f trim_;
};

}  // namespace mms
