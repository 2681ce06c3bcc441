#include "mms/localization/photometric/still_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "mms/core/upper_median.hpp"
#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

/// [-]: columns of blocks.
/// Source: initial choice; a person 3 m away covers a few of the blocks.
constexpr int kColumns = 8;

/// [-]: rows of blocks. Source: as `kColumns`, for images of 4:3.
constexpr int kRows = 6;

/// [1/px]: least intensity gradient of a pixel that votes.
/// Source: noise of 3 grey levels moves such an edge by less than `kMaxShift`.
constexpr float kMinGradient = 16.0F;

/// [px]: motion of an edge up to which it is unchanged.
/// Source: initial choice; 1.4 mm at 3 m for 525 px, at half of the size of the images.
constexpr float kMaxShift = 0.25F;

/// [grey levels]: noise of an unchanged pixel, besides. Source: initial choice; below the least
/// sigma of the photometric term, since it adds to `kMaxShift`.
constexpr float kMaxNoise = 2.0F;

/// [grey levels]: intensity of pixels that may be saturated. Source: the range ends at 255.
constexpr float kSaturated = 245.0F;

/// [-]: voting pixels of a block that votes. Source: initial choice; fewer may be noise.
constexpr int kMinPixels = 8;

/// [-]: share of them that makes a block unchanged.
/// Source: a Kinect that stands still has 0.8 to 1 in most blocks.
constexpr double kMinUnchangedPixels = 0.6;

/// [-]: blocks that must vote in each direction. Source: initial choice, an eighth of the image.
constexpr int kMinBlocks = 6;

/// [-]: share of them that must be unchanged.
/// Source: 0.8 and more between frames of a Kinect that stands still before a person without mask,
/// 0.59 over 40 frames; at most 0.46 over three frames of four hand-held cameras.
constexpr double kMinUnchangedBlocks = 0.5;

/// [-]: share of the depths that must be unchanged. Source: as `kMinUnchangedBlocks`.
constexpr double kMinUnchangedDepths = 0.5;

/// [-]: noise of the difference of two depths up to which they are equal, in sigmas of one.
/// Source: three sigma of a difference, three times the square root of two.
constexpr float kDepthSigmas = 4.2F;

/// [grey levels]: residual up to which a pixel counts for the exposure.
/// Source: initial choice; well above the noise, and the error of the median change.
constexpr float kMaxResidual = 30.0F;

/// [-]: passes of the exposure. Source: initial choice; the first one has pixels of moving objects.
constexpr int kExposurePasses = 3;

/// [-]: largest deviation of the gain from one. Source: as the photometric term; an image without
/// texture would agree at a gain of zero.
constexpr double kMaxGainChange = 0.5;

/// [grey levels^2]: variance of the intensities that determines a gain. Source: as the photometric
/// term, far above the resolution of an image.
constexpr double kMinVariance = 100.0;

/// [-]: frames after a view that must show it. Source: initial choice; a slow camera moves more
/// than `kMaxShift` meanwhile.
constexpr int kMinRepeated = 3;

/// [m]: distance of the estimated pose up to which the camera may stand still.
/// Source: people without masks move the estimate by up to 5 cm.
constexpr double kMaxDistance = 0.05;

/// [rad]: the same of the angle. Source: as `kMaxDistance` at 2.5 m.
constexpr double kMaxTurn = 0.02;

/// The votes of blocks for one direction of the gradient.
class BlockVotes {
 public:
  void add(std::size_t block, bool is_unchanged) {
    ++pixels_[block];
    if (is_unchanged) ++unchanged_[block];
  }

  bool are_for_same_view() const {
    int blocks = 0;
    int same = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      if (pixels_[i] < kMinPixels) continue;
      ++blocks;
      if (unchanged_[i] >= kMinUnchangedPixels * pixels_[i]) ++same;
    }
    return blocks >= kMinBlocks && same >= kMinUnchangedBlocks * blocks;
  }

 private:
  std::array<int, static_cast<std::size_t>(kColumns* kRows)> pixels_{};
  std::array<int, static_cast<std::size_t>(kColumns* kRows)> unchanged_{};
};

struct TexturedPixel {
  std::size_t block = 0;
  bool is_horizontal = false;  ///< its gradient
  float gradient = 0.0F;       ///< [1/px]
  float before = 0.0F;         ///< intensity
  float now = 0.0F;            ///< intensity
};

/// The static pixels of both images with texture in the earlier one.
std::vector<TexturedPixel> textured_pixels(const IntensityLevel& before,
                                           const IntensityLevel& now) {
  std::vector<TexturedPixel> pixels;
  const int width = before.intensity.width();
  const int height = before.intensity.height();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const IntensitySample& sample = before.intensity(x, y);
      const float gradient = std::hypot(sample.dx, sample.dy);
      if (gradient < kMinGradient) continue;
      if (before.depth(x, y) <= 0.0F || now.depth(x, y) <= 0.0F) continue;
      if (std::max(sample.value, now.intensity(x, y).value) > kSaturated) continue;
      const int block = (y * kRows / height) * kColumns + x * kColumns / width;
      pixels.push_back({static_cast<std::size_t>(block), std::abs(sample.dx) > std::abs(sample.dy),
                        gradient, sample.value, now.intensity(x, y).value});
    }
  }
  return pixels;
}

/// Change of the exposure: now = gain * before + bias, by least squares of the pixels that agree,
/// beginning with the median change.
struct Exposure {
  float gain = 1.0F;
  float bias = 0.0F;

  float residual(const TexturedPixel& pixel) const {
    return pixel.now - (gain * pixel.before + bias);
  }
};

float median_change(const std::vector<TexturedPixel>& pixels) {
  std::vector<float> changes;
  changes.reserve(pixels.size());
  for (const TexturedPixel& pixel : pixels) changes.push_back(pixel.now - pixel.before);
  return upper_median(std::move(changes));
}

/// The same for the pixels whose residuals are within `kMaxResidual`.
Exposure refined(const Exposure& exposure, const std::vector<TexturedPixel>& pixels) {
  double n = 0.0;
  double b = 0.0;
  double c = 0.0;
  double bb = 0.0;
  double bc = 0.0;
  for (const TexturedPixel& pixel : pixels) {
    if (std::abs(exposure.residual(pixel)) > kMaxResidual) continue;
    const auto before = static_cast<double>(pixel.before);
    const auto now = static_cast<double>(pixel.now);
    n += 1.0;
    b += before;
    c += now;
    bb += before * before;
    bc += before * now;
  }
  const double variance = n * bb - b * b;
  if (variance < kMinVariance * n * n) return exposure;
  const double gain = (n * bc - b * c) / variance;
  if (std::abs(gain - 1.0) > kMaxGainChange) return exposure;
  return {static_cast<float>(gain), static_cast<float>((c - gain * b) / n)};
}

Exposure exposure_of(const std::vector<TexturedPixel>& pixels) {
  Exposure exposure{1.0F, median_change(pixels)};
  for (int i = 0; i < kExposurePasses; ++i) exposure = refined(exposure, pixels);
  return exposure;
}

bool have_same_depth(const IntensityLevel& before, const IntensityLevel& now,
                     const DepthNoise& noise) {
  std::size_t both = 0;
  std::size_t same = 0;
  for (std::size_t i = 0; i < before.depth.size(); ++i) {
    const float z = before.depth[i];
    if (z <= 0.0F || now.depth[i] <= 0.0F) continue;
    ++both;
    if (std::abs(now.depth[i] - z) <= kDepthSigmas * noise.sigma(z)) ++same;
  }
  return static_cast<double>(same) >= kMinUnchangedDepths * static_cast<double>(both);
}

bool is_near(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d between = a.inverse() * b;
  return between.translation().norm() < kMaxDistance && se3::angle(between) < kMaxTurn;
}

}  // namespace

bool show_same_view(const IntensityLevel& before, const IntensityLevel& now,
                    const DepthNoise& noise) {
  if (before.camera != now.camera) return false;
  const std::vector<TexturedPixel> pixels = textured_pixels(before, now);
  if (pixels.empty()) return false;
  const Exposure exposure = exposure_of(pixels);
  BlockVotes horizontal;
  BlockVotes vertical;
  for (const TexturedPixel& pixel : pixels) {
    const bool is_unchanged =
        std::abs(exposure.residual(pixel)) < kMaxShift * pixel.gradient + kMaxNoise;
    (pixel.is_horizontal ? horizontal : vertical).add(pixel.block, is_unchanged);
  }
  return horizontal.are_for_same_view() && vertical.are_for_same_view() &&
         have_same_depth(before, now, noise);
}

bool StillCamera::shows(const View& view, const std::vector<IntensityLevel>& intensity,
                        const Eigen::Isometry3d& estimated) const {
  return !intensity.empty() && is_near(view.T_world_sensor, estimated) &&
         show_same_view(view.image, intensity.front(), noise_);
}

std::optional<Eigen::Isometry3d> StillCamera::pose(const std::vector<IntensityLevel>& intensity,
                                                   const Eigen::Isometry3d& estimated) const {
  for (const std::optional<View>* view : {&stop_, &latest_}) {
    if (!*view || (*view)->repeated < kMinRepeated) continue;
    if (shows(**view, intensity, estimated)) return (*view)->T_world_sensor;
  }
  return std::nullopt;
}

void StillCamera::follow(const std::vector<IntensityLevel>& intensity,
                         const Eigen::Isometry3d& T_world_sensor) {
  if (stop_ && !is_near(stop_->T_world_sensor, T_world_sensor)) stop_.reset();
  if (intensity.empty()) return;
  if (latest_ && shows(*latest_, intensity, T_world_sensor)) {
    const bool stops = ++latest_->repeated == kMinRepeated;
    if (stops && (!stop_ || !shows(*stop_, intensity, T_world_sensor))) stop_ = latest_;
  } else {
    latest_ = View{intensity.front(), T_world_sensor, 0};
  }
}

void StillCamera::forget() {
  latest_.reset();
  stop_.reset();
}

}  // namespace mms
