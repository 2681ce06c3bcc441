#include "mms/localization/photometric/image_shift.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mms/geometry/camera.hpp"
#include "mms/geometry/image_overlap.hpp"

namespace mms {
namespace {

/// [px]: width of the small images. Source: as PTAM; a pixel is 1.5 degrees of a common camera.
constexpr int kWidth = 40;

/// [-]: largest shift, as a share of the image's width and height. Source: beyond, less than a
/// quarter of the image is common to both.
constexpr double kMaxShift = 0.5;

/// [-]: share of all pixels that must be compared. Source: initial choice.
constexpr double kMinCompared = 0.15;

/// [-]: least correlation. Source: initial choice; registration decides later.
constexpr double kMinCorrelation = 0.3;

/// [-]: largest correlation that is distinguished from 1. Source: equal images have 1.
constexpr double kMaxCorrelation = 0.999;

/// [grey levels^2]: variance below which an image has nothing to compare. Source: its resolution.
constexpr double kMinVariance = 1.0;

/// Means of the static pixels of blocks; NaN without any.
Image<float> small_image(const IntensityLevel& level, int step) {
  Image<float> small(level.intensity.width() / step, level.intensity.height() / step);
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      float sum = 0.0F;
      float count = 0.0F;
      for (int v = step * y; v < step * (y + 1); ++v) {
        for (int u = step * x; u < step * (x + 1); ++u) {
          if (level.depth(u, v) <= 0.0F) continue;
          sum += level.intensity(u, v).value;
          count += 1.0F;
        }
      }
      small(x, y) = sum / count;
    }
  }
  return small;
}

/// Significance of the correlation of two images at a shift, in standard deviations of that of
/// independent pixels (Fisher's transformation): a small overlap correlates by chance. 0 without
/// enough pixels or correlation.
double significance(const Image<float>& before, const Image<float>& now, int dx, int dy) {
  const ImageOverlap overlap = image_overlap(before, now, dx, dy);
  if (overlap.count < kMinCompared * static_cast<double>(before.size())) return 0.0;
  if (std::min(overlap.variance_a, overlap.variance_b) < kMinVariance) return 0.0;
  const double correlation = overlap.correlation();
  if (correlation < kMinCorrelation) return 0.0;
  return std::atanh(std::min(correlation, kMaxCorrelation)) * std::sqrt(overlap.count);
}

struct Peak {
  double significance = 0.0;
  Eigen::Vector2d shift;  ///< from `before` to `now` [px]
};

bool is_peak(const Image<double>& values, int x, int y) {
  if (values(x, y) <= 0.0) return false;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (values.contains(x + dx, y + dy) && values(x + dx, y + dy) > values(x, y)) return false;
    }
  }
  return true;
}

/// Shifts that are more significant than those beside them, the most significant first.
std::vector<Peak> find_peaks(const Image<float>& before, const Image<float>& now) {
  const auto max_x = static_cast<int>(kMaxShift * before.width());
  const auto max_y = static_cast<int>(kMaxShift * before.height());
  Image<double> values(2 * max_x + 1, 2 * max_y + 1);
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x)
      values(x, y) = significance(before, now, x - max_x, y - max_y);
  }
  std::vector<Peak> peaks;
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      if (is_peak(values, x, y)) peaks.push_back({values(x, y), {x - max_x, y - max_y}});
    }
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.significance > b.significance; });
  return peaks;
}

}  // namespace

std::vector<Eigen::Matrix3d> rotations_by_shift(const IntensityLevel& before,
                                                const IntensityLevel& now, std::size_t max_count) {
  const int step = std::max(1, before.intensity.width() / kWidth);
  const Image<float> a = small_image(before, step);
  const Image<float> b = small_image(now, step);
  if (a.empty() || a.width() != b.width() || a.height() != b.height()) return {};
  const CameraModel camera(now.camera);
  const Eigen::Vector2d center(0.5 * (now.camera.width - 1), 0.5 * (now.camera.height - 1));
  std::vector<Eigen::Matrix3d> rotations;
  for (const Peak& peak : find_peaks(a, b)) {
    if (rotations.size() == max_count) break;
    const Eigen::Vector3d now_at = camera.ray(center + step * peak.shift);
    rotations.push_back(
        Eigen::Quaterniond::FromTwoVectors(now_at, camera.ray(center)).toRotationMatrix());
  }
  return rotations;
}

}  // namespace mms
