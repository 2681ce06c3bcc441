#include "mms/dataset/plausibility/image_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mms/core/upper_median.hpp"
#include "mms/geometry/image_blur.hpp"
#include "mms/geometry/image_overlap.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

/// [px]: width of the images whose shift is measured.
constexpr int kSmallWidth = 64;

/// Fewer frames prove nothing.
constexpr std::size_t kMinFrames = 4;
/// [0 to 255]: standard deviation of the brightness of an image with texture. Source: initial
/// choice; dark images and white walls have less.
constexpr double kMinContrast = 4.0;
/// [image widths]: median shift between frames. Source: `fr1_xyz_clip` with every sixth frame has
/// 0.056 and an ATE of 1 cm, with every tenth 0.078 and 12 cm; scene `fast` has 0.031.
constexpr double kMaxShift = 0.07;
/// [-]: median of `image_blur` at half size. Source: recordings have 0.23 to 0.31, scene `fast`
/// 0.42, a blur of 9 px 0.52.
constexpr double kMaxBlur = 0.5;

/// Brightness, as means of squares.
Image<float> small_gray(const Image<Rgb>& color) {
  const int side = std::max(1, color.width() / kSmallWidth);
  Image<float> small(color.width() / side, color.height() / side);
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      float sum = 0.0F;
      for (int dy = 0; dy < side; ++dy) {
        for (int dx = 0; dx < side; ++dx) {
          sum += static_cast<float>(color(side * x + dx, side * y + dy).g);
        }
      }
      small(x, y) = sum / static_cast<float>(side * side);
    }
  }
  return small;
}

/// Whether an image has enough texture to see its motion; not if the lens is covered.
bool has_texture(const Image<float>& image) {
  double sum = 0.0;
  double squares = 0.0;
  for (const float value : image.pixels()) {
    sum += static_cast<double>(value);
    squares += static_cast<double>(value) * static_cast<double>(value);
  }
  const auto count = static_cast<double>(image.size());
  return squares / count - (sum / count) * (sum / count) > kMinContrast * kMinContrast;
}

/// Shift with the best correlation, as a share of the width.
double shift_of(const Image<float>& a, const Image<float>& b) {
  double best = -std::numeric_limits<double>::infinity();
  double shift = 0.0;
  for (int dy = -a.height() / 2; dy <= a.height() / 2; ++dy) {
    for (int dx = -a.width() / 2; dx <= a.width() / 2; ++dx) {
      const double found = image_overlap(a, b, dx, dy).correlation();
      if (found <= best) continue;
      best = found;
      shift = std::hypot(dx, dy);
    }
  }
  return shift / a.width();
}

Image<Rgb> half_of(const Image<Rgb>& color) {
  Image<Rgb> half(color.width() / 2, color.height() / 2);
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) half(x, y) = color(2 * x, 2 * y);
  }
  return half;
}

}  // namespace

void ImageMotion::add(Timestamp stamp, const Image<Rgb>& color, bool begins) {
  Image<float> small = small_gray(color);
  if (!has_texture(small)) {
    before_ = {};
    return;
  }
  const Image<Rgb> half = half_of(color);
  blurs_.push_back(image_blur(half.pixels(), half.width(), half.height()));
  if (!begins && small.width() == before_.width() && small.height() == before_.height()) {
    shifts_.push_back(shift_of(before_, small));
    intervals_.push_back(to_seconds(stamp - stamp_));
  }
  before_ = std::move(small);
  stamp_ = stamp;
}

std::vector<std::string> ImageMotion::faults() const {
  std::vector<std::string> faults;
  if (shifts_.size() < kMinFrames) return faults;
  const double shift = upper_median(shifts_);
  if (shift > kMaxShift) {
    faults.push_back("the image moves by " + format_number(std::round(100.0 * shift)) +
                     " % of its width between frames, " +
                     format_number(std::round(1e3 * upper_median(intervals_))) +
                     " ms apart: record more frames per second, or move slower");
  }
  const double blur = upper_median(blurs_);
  if (blur > kMaxBlur) {
    faults.push_back("the images are blurred (" + format_number(std::round(100.0 * blur)) +
                     " %, sharp ones have about 30 %): is the exposure too long for the motion, or "
                     "the lens out of focus?");
  }
  return faults;
}

}  // namespace mms
