#include "mms/segmentation/mask_enlargement.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

constexpr float kThreshold = 0.5F;
constexpr float kStride = 4.0F;  // input pixels per mask pixel

/// Where the pixels of one axis of the picture lie in the mask.
class Axis {
 public:
  Axis(int picture, int valid, int mask) : picture_(picture), mask_(mask) {
    step_ = static_cast<float>(valid) / static_cast<float>(picture) / kStride;
  }

  struct Place {
    int low = 0;
    int high = 0;
    float share = 0.0F;  ///< of `high`
  };

  Place place(int pixel) const {
    const float at = (static_cast<float>(pixel) + 0.5F) * step_ - 0.5F;
    const float within = std::clamp(at, 0.0F, static_cast<float>(mask_ - 1));
    const int low = static_cast<int>(within);
    return {low, std::min(low + 1, mask_ - 1), within - static_cast<float>(low)};
  }

  /// Pixels whose value may depend on the mask pixels first..last: inclusive range.
  std::pair<int, int> reach(int first, int last) const {
    const auto pixel = [&](float at) { return (at + 0.5F) / step_ - 0.5F; };
    const int low = static_cast<int>(std::floor(pixel(static_cast<float>(first - 1))));
    const int high = static_cast<int>(std::ceil(pixel(static_cast<float>(last + 1))));
    return {first == 0 ? 0 : std::max(0, low), std::min(picture_ - 1, high)};
  }

 private:
  int picture_ = 0;
  int mask_ = 0;
  float step_ = 0.0F;
};

struct Box {
  int left = 0;
  int right = -1;
  int top = 0;
  int bottom = -1;
};

/// Box of the values above the threshold.
Box bounds(const std::vector<float>& soft, int width) {
  const int height = static_cast<int>(soft.size()) / width;
  Box box{width, -1, height, -1};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (soft[static_cast<std::size_t>(y * width + x)] <= kThreshold) continue;
      box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y),
             std::max(box.bottom, y)};
    }
  }
  return box;
}

/// Crops a detection to the rows and columns that its mask is in.
Detection cropped(Detection loose) {
  Box box{loose.mask.width(), -1, loose.mask.height(), -1};
  for (int y = 0; y < loose.mask.height(); ++y) {
    for (int x = 0; x < loose.mask.width(); ++x) {
      if (loose.mask(x, y) == 0) continue;
      box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y),
             std::max(box.bottom, y)};
    }
  }
  if (box.right < box.left) return {};
  Detection tight;
  tight.x = loose.x + box.left;
  tight.y = loose.y + box.top;
  tight.mask = {box.right - box.left + 1, box.bottom - box.top + 1};
  for (int y = 0; y < tight.mask.height(); ++y) {
    std::copy_n(loose.mask.row(box.top + y) + box.left, tight.mask.width(), tight.mask.row(y));
  }
  return tight;
}

}  // namespace

Detection enlarged_mask(const std::vector<float>& soft, int mask_width,
                        const PreparedImage& prepared) {
  const Box box = bounds(soft, mask_width);
  if (box.right < box.left) return {};
  const int mask_height = static_cast<int>(soft.size()) / mask_width;
  const Axis columns(prepared.image_width, prepared.valid_width, mask_width);
  const Axis rows(prepared.image_height, prepared.valid_height, mask_height);
  const auto [left, right] = columns.reach(box.left, box.right);
  const auto [top, bottom] = rows.reach(box.top, box.bottom);
  if (right < left || bottom < top) return {};  // in the padding
  Detection loose;
  loose.x = left;
  loose.y = top;
  loose.mask = {right - left + 1, bottom - top + 1};
  std::vector<Axis::Place> places;
  for (int x = left; x <= right; ++x) places.push_back(columns.place(x));
  for (int y = top; y <= bottom; ++y) {
    const Axis::Place v = rows.place(y);
    const float* low = soft.data() + v.low * mask_width;
    const float* high = soft.data() + v.high * mask_width;
    std::uint8_t* out = loose.mask.row(y - top);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Axis::Place& u = places[i];
      const float a = low[u.low] + u.share * (low[u.high] - low[u.low]);
      const float b = high[u.low] + u.share * (high[u.high] - high[u.low]);
      out[i] = a + v.share * (b - a) > kThreshold ? 1 : 0;
    }
  }
  return cropped(std::move(loose));
}

}  // namespace mms
