#include "mms/dataset/plausibility/recording_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "mms/core/size_text.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

/// Every so many pixels a depth is kept.
constexpr std::size_t kDepthStride = 37;
/// [-]: share of the pixels with depth below which a recording has none. The least of a recording
/// here, `still_walker`, is 0.46.
constexpr double kMinValidShare = 0.03;
/// Larger images are not checked in sequence, which would take seconds.
constexpr std::size_t kMaxPixels = 1'500'000;
/// [m]: far depth (98 % are nearer) that depth cameras have in rooms. The recordings and scenes
/// here have 2.9 to 8.5 m; with a scale wrong by 5, at most 1.7 or at least 14 m.
constexpr double kMinFar = 2.0;
constexpr double kMaxFar = 12.0;
/// [m]: depths that differ less are constant.
constexpr double kConstant = 0.01;
/// [0 to 255]: images darker or brighter than this on average have little texture left.
constexpr double kDark = 12.0;
constexpr double kBright = 243.0;
/// [-]: distance of the principal point from the center, in image sides. Lens and sensor of a
/// camera are off by a few hundredths; cx and cy swapped at 640x480 by 0.125 and 0.167.
constexpr double kMaxOffset = 0.15;
/// [-]: the same, if swapping cx and cy would bring it to less than half of that.
constexpr double kMaxOffsetIfSwapped = 0.08;
/// [-]: ratio of fx and fy for square pixels.
constexpr double kMaxAspect = 1.1;
/// [degrees]: horizontal field of view.
constexpr double kMinView = 15.0;
constexpr double kMaxView = 140.0;

double percentile_of(std::vector<float> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

std::string rounded(double value, int decimals) {
  const double power = std::pow(10.0, decimals);
  return format_number(std::round(value * power) / power);
}

template <class T>
bool is_beside(const Image<T>& image, const Image<Rgb>& color) {
  return !image.empty() && image.width() == color.width() && image.height() == color.height();
}

double mean_brightness(const Image<Rgb>& color) {
  double sum = 0.0;
  for (const Rgb& c : color.pixels()) sum += c.r + c.g + c.b;
  return sum / (3.0 * static_cast<double>(color.size()));
}

}  // namespace

std::vector<std::string> camera_faults(const CameraIntrinsics& camera) {
  std::vector<std::string> faults;
  const auto offset_of = [&](double cx, double cy) {
    return std::max(std::abs((cx + 0.5) / camera.width - 0.5),
                    std::abs((cy + 0.5) / camera.height - 0.5));
  };
  const double offset = offset_of(camera.cx, camera.cy);
  const bool swapped =
      offset > kMaxOffsetIfSwapped && 2.0 * offset_of(camera.cy, camera.cx) < offset;
  const std::string size = size_text(camera.width, camera.height);
  if (offset > kMaxOffset || swapped) {
    faults.push_back("cx, cy = " + rounded(camera.cx, 1) + ", " + rounded(camera.cy, 1) +
                     " is far from the center of images of " + size +
                     ": are the intrinsics swapped, or for another resolution?");
  }
  const double aspect = std::max(camera.fx / camera.fy, camera.fy / camera.fx);
  if (aspect > kMaxAspect) {
    faults.push_back("fx, fy = " + rounded(camera.fx, 1) + ", " + rounded(camera.fy, 1) +
                     " differ by " + rounded(100.0 * (aspect - 1.0), 0) +
                     " %: pixels of cameras are square; are the intrinsics swapped?");
  }
  const double view = 2.0 * std::atan(0.5 * camera.width / camera.fx) * 180.0 / std::numbers::pi;
  if (view < kMinView || view > kMaxView) {
    faults.push_back("fx = " + rounded(camera.fx, 1) + " px means a field of view of " +
                     rounded(view, 0) + " degrees for images of " + size +
                     ": are the intrinsics for another resolution?");
  }
  return faults;
}

void RecordingCheck::add(const Frame& frame) {
  ++frames_;
  calibration_ = frame.calibration;
  if (!frame.color.empty()) brightness_.push_back(mean_brightness(frame.color));
  if (is_beside(frame.mask, frame.color)) mask_alignment_.add(mask_edges(frame.color, frame.mask));
  if (frame.depth.empty()) return;
  depth_pixels_ += frame.depth.size() / kDepthStride;
  for (std::size_t i = 0; i < frame.depth.size(); i += kDepthStride) {
    if (std::isfinite(frame.depth[i]) && frame.depth[i] > 0.0F) depths_.push_back(frame.depth[i]);
  }
  if (is_beside(frame.depth, frame.color)) {
    depth_alignment_.add(depth_edges(frame.color, frame.depth));
  }
}

void RecordingCheck::add_in_sequence(const Frame& frame) {
  if (frame.color.empty() || frame.color.size() > kMaxPixels) return;
  const bool begins = in_sequence_ == 0 || frame.index != last_index_ + 1;
  ++in_sequence_;
  last_index_ = frame.index;
  motion_.add(frame.stamp, frame.color, begins);
  if (is_beside(frame.depth, frame.color)) {
    depth_delay_.add(frame.stamp, depth_edges(frame.color, frame.depth), begins);
  }
  if (is_beside(frame.mask, frame.color)) {
    mask_delay_.add(frame.stamp, mask_edges(frame.color, frame.mask), begins);
  }
}

std::vector<std::string> RecordingCheck::edge_faults() const {
  std::vector<std::string> faults;
  if (const auto fault = depth_alignment_.fault(depth_delay_.gain(depth_delay_.frames()))) {
    faults.push_back("the depth is " + *fault +
                     "; depth images must be registered to the color images, or their camera be "
                     "stated as depth_camera in calibration.yaml");
  } else if (const auto delay = depth_delay_.fault()) {
    faults.push_back("the depth images are " + *delay +
                     ": correct their stamps, or which of them belong together");
  }
  if (const auto fault = mask_alignment_.fault(mask_delay_.gain(mask_delay_.frames()))) {
    faults.push_back("the masks are " + *fault + ": are they those of these images?");
  } else if (const auto delay = mask_delay_.fault()) {
    faults.push_back("the masks are " + *delay +
                     ": do their names have the right stamps or numbers?");
  }
  return faults;
}

std::vector<std::string> RecordingCheck::depth_faults() const {
  if (depth_pixels_ == 0) return {};
  const double share = static_cast<double>(depths_.size()) / static_cast<double>(depth_pixels_);
  if (share < kMinValidShare) {
    return {"only " + rounded(100.0 * share, 1) +
            " % of the depth pixels have a value: are these the depth images?"};
  }
  const double near = percentile_of(depths_, 0.02);
  const double far = percentile_of(depths_, 0.98);
  if (far - near < kConstant) {
    return {"all depths are " + rounded(far, 3) + " m: are these the depth images?"};
  }
  std::vector<std::string> faults;
  const bool in_meters = calibration_ && calibration_->depth_scale == 1.0;
  if (!in_meters && (far < kMinFar || far > kMaxFar)) {
    faults.push_back("98 % of the depths are below " + rounded(far, 2) +
                     " m, in rooms it is 2 to 12 m: is the depth scale of " +
                     format_number(calibration_ ? calibration_->depth_scale : 0.0) +
                     " units per meter right (--depth-scale)?");
  }
  return faults;
}

std::vector<std::string> RecordingCheck::faults() const {
  std::vector<std::string> faults = depth_faults();
  for (std::string& fault : edge_faults()) faults.push_back(std::move(fault));
  for (std::string& fault : motion_.faults()) faults.push_back(std::move(fault));
  if (calibration_ && calibration_->camera) {
    for (std::string& fault : camera_faults(*calibration_->camera)) {
      faults.push_back(std::move(fault));
    }
  }
  if (brightness_.empty()) return faults;
  const double mean = std::accumulate(brightness_.begin(), brightness_.end(), 0.0) /
                      static_cast<double>(brightness_.size());
  if (mean < kDark || mean > kBright) {
    faults.push_back("the images are too " + std::string(mean < kDark ? "dark" : "bright") +
                     ": their mean is " + rounded(mean, 0) + " of 255");
  }
  return faults;
}

}  // namespace mms
