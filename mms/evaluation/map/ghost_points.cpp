#include "mms/evaluation/map/ghost_points.hpp"

#include <algorithm>
#include <cmath>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/geometry/camera.hpp"

namespace mms {
namespace {

constexpr double kMaxGap = 0.05;       ///< share of the depth that separates two modes
constexpr std::size_t kMinImages = 4;  ///< kept of images of any size
constexpr std::size_t kMaxImages = 1000;
constexpr double kMinShare = 0.10;  ///< smallest share of a pixel's returns in a mode

/// Median of the farthest sufficiently long run of sorted depths; 0 if none.
double far_mode_of(const std::vector<std::uint16_t>& sorted) {
  const auto least =
      static_cast<std::size_t>(std::max(2.0, kMinShare * static_cast<double>(sorted.size())));
  std::size_t end = sorted.size();
  while (end > 0) {
    std::size_t begin = end - 1;
    while (begin > 0 && sorted[begin] - sorted[begin - 1] <= kMaxGap * sorted[begin]) --begin;
    if (end - begin >= least) return 1e-3 * sorted[begin + (end - begin) / 2];
    end = begin;
  }
  return 0.0;
}

}  // namespace

void RoomDepth::add(const Image<float>& depth) {
  if (!millimetres_.empty() && !millimetres_.front().same_size(depth)) {
    throw DataError("depth image",
                    "is " + size_text(depth.width(), depth.height()) +
                        " pixels, earlier images have " +
                        size_text(millimetres_.front().width(), millimetres_.front().height()));
  }
  if (added_++ % step_ != 0) return;
  Image<std::uint16_t> raw(depth.width(), depth.height());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const float mm = 1000.0F * depth[i];
    raw[i] = mm > 0.0F && mm < 65535.0F ? static_cast<std::uint16_t>(mm + 0.5F) : std::uint16_t{0};
  }
  millimetres_.push_back(std::move(raw));
  const std::size_t pixels = std::max<std::size_t>(depth.size(), 1);
  if (millimetres_.size() <= std::clamp(max_pixels_ / pixels, kMinImages, kMaxImages)) return;
  std::vector<Image<std::uint16_t>> kept;
  for (std::size_t i = 0; i < millimetres_.size(); i += 2) {
    kept.push_back(std::move(millimetres_[i]));
  }
  millimetres_ = std::move(kept);
  step_ *= 2;
}

Image<float> RoomDepth::far_mode() const {
  if (millimetres_.empty()) return {};
  Image<float> room(millimetres_.front().width(), millimetres_.front().height(), 0.0F);
  std::vector<std::uint16_t> depths;
  for (std::size_t i = 0; i < room.size(); ++i) {
    depths.clear();
    for (const Image<std::uint16_t>& image : millimetres_) {
      if (image[i] > 0) depths.push_back(image[i]);
    }
    std::sort(depths.begin(), depths.end());
    room[i] = static_cast<float>(far_mode_of(depths));
  }
  return room;
}

GhostPointCount evaluate_ghost_points(std::span<const Eigen::Vector3f> map,
                                      const Image<float>& room_depth,
                                      const CameraIntrinsics& camera, double margin) {
  const CameraModel model(camera);
  GhostPointCount result;
  result.points = map.size();
  for (const Eigen::Vector3f& point : map) {
    const Eigen::Vector3d p = point.cast<double>();
    if (!p.allFinite() || !model.in_lens_range(p)) continue;
    const Eigen::Vector2d pixel = model.project(p);
    const int x = static_cast<int>(std::lround(pixel.x()));
    const int y = static_cast<int>(std::lround(pixel.y()));
    if (!room_depth.contains(x, y) || room_depth(x, y) <= 0.0F) continue;
    ++result.seen;
    if (p.z() < static_cast<double>(room_depth(x, y)) - margin) ++result.ghost_points;
  }
  if (result.points > 0) {
    result.percent =
        100.0 * static_cast<double>(result.ghost_points) / static_cast<double>(result.points);
  }
  return result;
}

std::vector<MetricValue> metric_values(const GhostPointCount& ghost_points) {
  return {{"points", "map points", static_cast<double>(ghost_points.points), "", 0},
          {"seen", "seen by the camera", static_cast<double>(ghost_points.seen), "", 0},
          {"ghost_points", "in front of the background",
           static_cast<double>(ghost_points.ghost_points), "", 0},
          {"ghost_pct", "share of the map", ghost_points.percent, "%", 3}};
}

}  // namespace mms
