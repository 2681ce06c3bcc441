#include "mms/run/repeated_frames.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstring>

namespace mms {
namespace {

/// [s]: age of a color image up to which frames are left out that repeat it with another depth.
/// Source: initial choice; a slower camera has at least 4 Hz, and a broken one does not end the
/// run.
constexpr Duration kMaxSameColor = std::chrono::milliseconds(250);

/// Bit by bit, since NaN does not equal itself.
template <class T>
bool are_same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Whether an image has one color, as in the dark.
bool is_uniform(const Image<Rgb>& image) {
  const std::vector<Rgb>& pixels = image.pixels();
  return std::all_of(pixels.begin(), pixels.end(),
                     [&](const Rgb& pixel) { return pixel == pixels.front(); });
}

/// Whether a frame shows anything: a covered sensor sees nothing again and again.
bool shows_anything(const Frame& frame) {
  const std::vector<float>& depth = frame.depth.pixels();
  return !frame.scan.points.empty() ||
         std::any_of(depth.begin(), depth.end(), [](float z) { return z > 0.0F; });
}

}  // namespace

bool RepeatedFrames::omits(Frame& frame, const WarningHandler& warn) {
  const bool had_old_color = has_old_color_;
  const bool is_kept = keeps(frame);
  if (!warn) return !is_kept;
  if (!is_kept && count_ == 1) {
    warn(fmt::format(
        "frame {}: repeats an image or scan of the frame before: such frames are left out",
        frame.name));
  }
  if (has_old_color_ && !had_old_color) {
    warn(fmt::format("frame {}: the color image does not change any more: the depth is used alone",
                     frame.name));
  }
  return !is_kept;
}

bool RepeatedFrames::keeps(Frame& frame) {
  if (repeats(frame)) {
    left_out_.add(frame);
    ++count_;
    return false;
  }
  left_out_.give_to(frame);
  keep(frame);
  if (has_old_color_) frame.color = {};
  return true;
}

bool RepeatedFrames::repeats(const Frame& frame) {
  const bool same_color = frame.has_depth() && !is_uniform(frame.color) &&
                          are_same(frame.color.pixels(), color_.pixels());
  has_old_color_ = same_color && frame.stamp - color_since_ > kMaxSameColor;
  if (!shows_anything(frame)) return false;
  const bool same_points = frame.has_depth() ? are_same(frame.depth.pixels(), depth_.pixels())
                                             : are_same(frame.scan.points, points_);
  return same_points || (same_color && !has_old_color_);
}

void RepeatedFrames::keep(const Frame& frame) {
  if (!are_same(frame.color.pixels(), color_.pixels())) {
    color_ = frame.color;
    color_since_ = frame.stamp;
  }
  depth_ = frame.depth;
  points_ = frame.scan.points;
}

}  // namespace mms
