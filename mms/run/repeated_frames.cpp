#include "mms/run/repeated_frames.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

namespace mms {
namespace {

/// [s]: time for which frames are left out of which one image alone is repeated. Source: initial
/// choice; a slower camera has at least 4 Hz, and the other camera of a broken one must go on.
constexpr Duration kMaxOneRepeated = std::chrono::milliseconds(250);

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

template <class T>
void put_before(std::vector<T>&& earlier, std::vector<T>& samples) {
  samples.insert(samples.begin(), earlier.begin(), earlier.end());
  earlier.clear();
}

}  // namespace

bool RepeatedFrames::repeats(const Frame& frame) const {
  if (!frame.has_depth()) {
    return shows_anything(frame) && are_same(frame.scan.points, points_);
  }
  if (!shows_anything(frame)) return false;
  const bool same_depth = are_same(frame.depth.pixels(), depth_.pixels());
  const bool same_color =
      are_same(frame.color.pixels(), color_.pixels()) && !is_uniform(frame.color);
  if (same_depth && same_color) return true;
  return (same_depth || same_color) && frame.stamp - stamp_ <= kMaxOneRepeated;
}

bool RepeatedFrames::omits(Frame& frame) {
  put_before(std::move(motion_.wheels), frame.motion.wheels);
  put_before(std::move(motion_.imu), frame.motion.imu);
  if (!frame.expected_place) frame.expected_place = expected_place_;
  expected_place_.reset();
  if (repeats(frame)) {
    motion_ = std::move(frame.motion);
    expected_place_ = frame.expected_place;
    ++count_;
    return true;
  }
  stamp_ = frame.stamp;
  color_ = frame.color;
  depth_ = frame.depth;
  points_ = frame.scan.points;
  return false;
}

}  // namespace mms
