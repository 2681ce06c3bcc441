#include "mms/localization/photometric_term.hpp"

#include <algorithm>
#include <cmath>

#include "mms/geometry/camera.hpp"
#include "mms/geometry/parallel.hpp"

namespace mms {
namespace {

constexpr std::size_t kChunk = 512;
constexpr int kBorder = 2;        ///< pixels left out at the image border
constexpr int kSmoothing = 2;     ///< half width of the depth average [px]
constexpr double kFreedom = 5.0;  ///< degrees of freedom of the t-distribution
constexpr double kMadToSigma = 1.4826;
constexpr double kMaxGainChange = 0.5;

/// Mean depth of the pixels around (x, y) on the same surface; 0 at depth discontinuities, where
/// the depth at the pixel may be another surface's.
float surface_depth(const Image<float>& depth, int x, int y, const DepthNoise& noise,
                    double focal) {
  const float centre = depth(x, y);
  if (centre <= 0.0F) return 0.0F;
  const float slope = 3.0F * centre / static_cast<float>(focal) * kSmoothing;
  const float gate = 4.0F * noise.sigma(centre) + slope;
  float sum = 0.0F;
  int count = 0;
  for (int dy = -kSmoothing; dy <= kSmoothing; ++dy) {
    for (int dx = -kSmoothing; dx <= kSmoothing; ++dx) {
      if (!depth.contains(x + dx, y + dy)) continue;
      const float d = depth(x + dx, y + dy);
      if (d <= 0.0F) continue;
      if (std::abs(d - centre) > gate) return 0.0F;
      sum += 1.0F / d;
      ++count;
    }
  }
  constexpr int kMinSupport = 8;
  return count >= kMinSupport ? static_cast<float>(count) / sum : 0.0F;
}

std::vector<TexturedPoint> textured_points(const IntensityLevel& level,
                                           const PhotometricConfig& config,
                                           const DepthNoise& noise) {
  const CameraModel camera(level.camera);
  const auto min_square = static_cast<float>(config.min_gradient * config.min_gradient);
  const int side = config.cell_px;
  std::vector<TexturedPoint> points;
  for (int top = kBorder; top < level.camera.height - kBorder; top += side) {
    for (int left = kBorder; left < level.camera.width - kBorder; left += side) {
      float strongest = min_square;
      int best_x = -1;
      int best_y = -1;
      for (int y = top; y < std::min(top + side, level.camera.height - kBorder); ++y) {
        for (int x = left; x < std::min(left + side, level.camera.width - kBorder); ++x) {
          const IntensitySample& s = level.intensity(x, y);
          const float square = s.dx * s.dx + s.dy * s.dy;
          if (square <= strongest || level.depth(x, y) <= 0.0F) continue;
          strongest = square;
          best_x = x;
          best_y = y;
        }
      }
      if (best_x < 0) continue;
      const float z = surface_depth(level.depth, best_x, best_y, noise, level.camera.fx);
      if (z <= 0.0F) continue;
      const Eigen::Vector3f ray = camera.ray({best_x, best_y}).cast<float>();
      points.push_back({z * ray, level.intensity(best_x, best_y).value});
    }
  }
  return points;
}

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
    return measured > 0.0F &&
           std::abs(static_cast<double>(measured) - z) < config_.depth_gate + 3.0 * noise_.sigma(z);
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

void PhotometricConfig::visit(ConfigVisitor& v) {
  v.boolean({"enabled", "", "add photometric residuals to the geometric ones (images with depth)"},
            enabled);
  v.number({"min_gradient", "1/px", "least intensity gradient of a textured pixel"}, min_gradient,
           {0.5, 100.0});
  v.integer({"cell_px", "px", "one textured pixel is taken from a cell of this side"}, cell_px,
            {1, 32});
  v.number({"min_sigma", "", "least standard deviation of the residuals, in grey levels"},
           min_sigma, {0.1, 100.0});
  v.number({"weight", "", "weight of the photometric residuals against the geometric"}, weight,
           {0.0, 1000.0});
  v.number({"depth_gate", "m", "largest difference of predicted and measured depth, noise apart"},
           depth_gate, {0.0, 1.0});
  v.integer({"references", "", "keyframes a frame is compared with"}, references, {1, 8});
  v.number({"keyframe_translation", "m", "distance to all keyframes that makes a new one"},
           keyframe_translation, {0.001, 10.0});
  v.number({"keyframe_rotation", "deg", "angle to all keyframes that makes a new one"},
           keyframe_rotation, {0.1, 90.0});
  v.integer({"max_keyframes", "", "keyframes kept; the farthest goes first"}, max_keyframes,
            {1, 10000});
}

IntensityKeyframe make_intensity_keyframe(const std::vector<IntensityLevel>& levels,
                                          const Eigen::Isometry3d& T_world_sensor,
                                          const PhotometricConfig& config,
                                          const DepthNoise& noise) {
  IntensityKeyframe keyframe{T_world_sensor, {}};
  for (const IntensityLevel& level : levels) {
    keyframe.levels.push_back(textured_points(level, config, noise));
  }
  return keyframe;
}

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
  if (variance > 1.0) {
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
