#include "mms/localization/photometric/photometric_term.hpp"

#include <algorithm>
#include <cmath>

#include "mms/geometry/camera.hpp"
#include "mms/geometry/parallel.hpp"

namespace mms {
namespace {

/// [-]: points of one parallel task; fixed, since it determines the order of the sums.
/// Source: tens of microseconds, long against the task's start.
constexpr std::size_t kChunk = 512;

/// [px]: pixels left out at the image border.
/// Source: one for bilinear interpolation and one for central differences.
constexpr int kBorder = 2;

/// [-]: degrees of freedom of the t-distribution. Source: Kerl et al., ICRA 2013.
constexpr double kFreedom = 5.0;

/// [-]: standard deviation over median absolute deviation.
/// Source: normal distribution, the inverse of its 75 % quantile.
constexpr double kMadToSigma = 1.4826;

/// [-]: largest deviation of the gain from one. Source: initial choice; a gain beyond it is
/// taken for an error of few points.
constexpr double kMaxGainChange = 0.5;

/// [grey levels^2]: least variance of the keyframe's intensities that determines a gain.
/// Source: one grey level, the resolution of an image.
constexpr double kMinVariance = 1.0;

/// [-]: depth noise up to which predicted and measured depth agree, in sigmas.
/// Source: three-sigma rule.
constexpr double kDepthSigmas = 3.0;

/// Bilinear interpolation of value and derivatives; the pixel must be inside the border.
IntensitySample interpolate(const Image<IntensitySample>& image, double u, double v) {
  const int x = static_cast<int>(u);
  const int y = static_cast<int>(v);
  const auto a = static_cast<float>(u - x);
  const auto b = static_cast<float>(v - y);
  const IntensitySample* top = image.row(y) + x;
  const IntensitySample* low = image.row(y + 1) + x;
  const float w00 = (1.0F - a) * (1.0F - b);
  const float w10 = a * (1.0F - b);
  const float w01 = (1.0F - a) * b;
  const float w11 = a * b;
  return {w00 * top[0].value + w10 * top[1].value + w01 * low[0].value + w11 * low[1].value,
          w00 * top[0].dx + w10 * top[1].dx + w01 * low[0].dx + w11 * low[1].dx,
          w00 * top[0].dy + w10 * top[1].dy + w01 * low[0].dy + w11 * low[1].dy};
}

/// Adds one keyframe's points against the current image.
class Linearizer {
 public:
  Linearizer(const IntensityLevel& current, const Eigen::Isometry3d& T_current_keyframe,
             const PhotometricState& state, const PhotometricConfig& config,
             const DepthNoise& noise)
      : current_(current),
        camera_(current.camera),
        T_(T_current_keyframe),
        state_(state),
        config_(config),
        noise_(noise) {}

  void add(const TexturedPoint& textured, PhotometricEquations& sum) const {
    const Eigen::Vector3d p = T_ * textured.point.cast<double>();
    if (!camera_.in_lens_range(p)) return;
    Eigen::Matrix<double, 2, 3> projection;
    const Eigen::Vector2d pixel = camera_.project(p, projection);
    if (!inside(pixel) || !agrees_with_depth(pixel, p.z())) return;

    const IntensitySample sample = interpolate(current_.intensity, pixel.x(), pixel.y());
    const double residual = static_cast<double>(sample.value) -
                            (state_.gain * static_cast<double>(textured.intensity) + state_.bias);
    const double normalized = residual / state_.sigma;
    const double robust = (kFreedom + 1.0) / (kFreedom + normalized * normalized);
    const double weight = config_.weight * robust / (state_.sigma * state_.sigma);

    const Eigen::Vector3d by_point =
        projection.transpose() * Eigen::Vector2d(sample.dx, sample.dy);  // dr/dp
    Vector6d jacobian;  // p moves by -(translation + rotation x p) under a right perturbation
    jacobian.head<3>() = -by_point;
    jacobian.tail<3>() = by_point.cross(p);
    sum.equations.add(residual, jacobian, weight);
    record(residual, robust, textured.intensity, sample.value, sum);
  }

 private:
  bool inside(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= kBorder && pixel.y() >= kBorder &&
           pixel.x() < current_.camera.width - 1 - kBorder &&
           pixel.y() < current_.camera.height - 1 - kBorder;
  }

  bool agrees_with_depth(const Eigen::Vector2d& pixel, double z) const {
    const float measured =
        current_.depth(static_cast<int>(pixel.x() + 0.5), static_cast<int>(pixel.y() + 0.5));
    return measured > 0.0F && std::abs(static_cast<double>(measured) - z) <
                                  config_.depth_gate + kDepthSigmas * noise_.sigma(z);
  }

  static void record(double residual, double robust, float keyframe, float current,
                     PhotometricEquations& sum) {
    ++sum.visible;
    const auto bin = std::min<std::size_t>(sum.histogram.size() - 1,
                                           static_cast<std::size_t>(std::abs(residual)));
    ++sum.histogram[bin];
    const auto k = static_cast<double>(keyframe);
    const auto c = static_cast<double>(current);
    sum.sw += robust;
    sum.sk += robust * k;
    sum.sc += robust * c;
    sum.skk += robust * k * k;
    sum.skc += robust * k * c;
  }

  const IntensityLevel& current_;
  CameraModel camera_;
  Eigen::Isometry3d T_;
  const PhotometricState& state_;
  const PhotometricConfig& config_;
  DepthNoise noise_;
};

/// Median of the absolute residuals, interpolated within its bin.
double median(const std::array<std::uint32_t, 128>& histogram, int total) {
  const double half = 0.5 * total;
  double below = 0.0;
  for (std::size_t bin = 0; bin < histogram.size(); ++bin) {
    const double here = histogram[bin];
    if (here > 0.0 && below + here >= half) {
      return static_cast<double>(bin) + (half - below) / here;
    }
    below += here;
  }
  return static_cast<double>(histogram.size());
}

}  // namespace

PhotometricEquations& PhotometricEquations::operator+=(const PhotometricEquations& other) {
  equations += other.equations;
  visible += other.visible;
  for (std::size_t i = 0; i < histogram.size(); ++i) histogram[i] += other.histogram[i];
  sw += other.sw;
  sk += other.sk;
  sc += other.sc;
  skk += other.skk;
  skc += other.skc;
  return *this;
}

PhotometricState PhotometricEquations::next(const PhotometricState& now, double min_sigma) const {
  PhotometricState state = now;
  if (visible < 2 || sw <= 0.0) return state;
  state.sigma = std::max(min_sigma, kMadToSigma * median(histogram, visible));
  const double mean_k = sk / sw;
  const double mean_c = sc / sw;
  const double variance = skk / sw - mean_k * mean_k;
  const double covariance = skc / sw - mean_k * mean_c;
  if (variance > kMinVariance) {
    state.gain = std::clamp(covariance / variance, 1.0 - kMaxGainChange, 1.0 + kMaxGainChange);
  }
  state.bias = mean_c - state.gain * mean_k;
  return state;
}

PhotometricEquations photometric_equations(const IntensityKeyframe& keyframe, std::size_t level,
                                           const IntensityLevel& current,
                                           const Eigen::Isometry3d& T_world_sensor,
                                           const PhotometricState& state,
                                           const PhotometricConfig& config,
                                           const DepthNoise& noise) {
  const auto& points = keyframe.levels[level];
  const Eigen::Isometry3d T_current_keyframe = T_world_sensor.inverse() * keyframe.T_world_sensor;
  const Linearizer linearizer(current, T_current_keyframe, state, config, noise);
  return parallel_sum(points.size(), kChunk, PhotometricEquations{},
                      [&](std::size_t begin, std::size_t end) {
                        PhotometricEquations part;
                        for (std::size_t i = begin; i < end; ++i) linearizer.add(points[i], part);
                        return part;
                      });
}

}  // namespace mms
