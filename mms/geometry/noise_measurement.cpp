#include "mms/geometry/noise_measurement.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mms {
namespace {

/// [px]: distance of the outer pixels of a bend. Source: real depth images are smoothed over 2 to 3
/// px; farther pixels see more of the scene's own bends.
constexpr int kReach = 4;

/// [px]: spacing of the bends. Source: computing time; an image of 640 x 480 has 34,000.
constexpr int kSpacing = 3;

/// Fewer bends measure nothing.
constexpr std::size_t kMinBends = 1000;

/// [-]: share of the bends that are smaller than the measured one, and that bend in standard
/// deviations of noise. Source: normal distribution; edges and curved surfaces have larger bends.
constexpr double kShare = 0.25;
constexpr double kSigmasOfShare = 0.3186;

/// [-]: ratio from which on the noise is raised. Source: three real recordings have at most 0.8,
/// a test image with exactly the assumed noise 1.13.
constexpr double kMinRatio = 1.3;

/// [-]: largest ratio. Source: three times that of `d435`, the noisiest simulated camera.
constexpr double kMaxRatio = 10.0;

}  // namespace

double noise_ratio(const Image<float>& depth, const DepthNoise& assumed) {
  const double scale = std::sqrt(6.0);  // of the bend's noise: 1 + 4 + 1 variances
  std::vector<double> bends;
  for (int y = 0; y < depth.height(); y += kSpacing) {
    for (int x = kReach; x + kReach < depth.width(); x += kSpacing) {
      const auto left = static_cast<double>(depth(x - kReach, y));
      const auto z = static_cast<double>(depth(x, y));
      const auto right = static_cast<double>(depth(x + kReach, y));
      if (!(left > 0.0 && z > 0.0 && right > 0.0)) continue;
      if (!std::isfinite(left + z + right)) continue;
      const double bend = std::abs(1.0 / left - 2.0 / z + 1.0 / right) * z * z;
      bends.push_back(bend / (scale * assumed.sigma(z)));
    }
  }
  if (bends.size() < kMinBends) return 0.0;
  const auto at =
      bends.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(bends.size()));
  std::nth_element(bends.begin(), at, bends.end());
  return *at / kSigmasOfShare;
}

DepthNoise measured_noise(const DepthNoise& assumed, const Image<float>& depth) {
  const double ratio = std::min(noise_ratio(depth, assumed), kMaxRatio);
  if (ratio < kMinRatio) return assumed;
  DepthNoise raised = assumed;
  raised.base *= ratio;
  raised.quadratic *= ratio;
  return raised;
}

}  // namespace mms
