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
    std::size_t low = 0;
    std::size_t high = 0;
    float share = 0.0F;  ///< of `high`
  };

  Place place(int pixel) const {
    const float at = (static_cast<float>(pixel) + 0.5F) * step_ - 0.5F;
    const float within = std::clamp(at, 0.0F, static_cast<float>(mask_ - 1));
    const auto low = static_cast<std::size_t>(within);
    const std::size_t high = std::min(low + 1, static_cast<std::size_t>(mask_ - 1));
    return {low, high, within - static_cast<float>(low)};
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

/// Box of the values that count, in rows of `width`.
template <class Value, class Counts>
Box bounds(const std::vector<Value>& values, int width, const Counts& counts) {
  const int height = static_cast<int>(values.size()) / width;
  Box box{width, -1, height, -1};
  for (int y = 0; y < height; ++y) {
    const Value* row = values.data() + y * width;
    const auto left = static_cast<int>(std::find_if(row, row + width, counts) - row);
    if (left == width) continue;
    int right = width - 1;
    while (!counts(row[right])) --right;
    box = {std::min(box.left, left), std::max(box.right, right), std::min(box.top, y), y};
  }
  return box;
}

/// The mask between two of its rows.
void mix_rows(const std::vector<float>& soft, const Axis::Place& place, std::vector<float>& row) {
  const float* low = soft.data() + place.low * row.size();
  const float* high = soft.data() + place.high * row.size();
  for (std::size_t x = 0; x < row.size(); ++x) row[x] = low[x] + place.share * (high[x] - low[x]);
}

/// Crops a detection to the rows and columns that its mask is in.
Detection cropped(Detection loose) {
  const Box box = bounds(loose.mask.pixels(), loose.mask.width(),
                         [](std::uint8_t value) { return value != 0; });
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
  const Box box =
      bounds(soft, mask_width, [](float probability) { return probability > kThreshold; });
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
  std::vector<float> row(static_cast<std::size_t>(mask_width));
  for (int y = top; y <= bottom; ++y) {
    mix_rows(soft, rows.place(y), row);
    std::uint8_t* out = loose.mask.row(y - top);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Axis::Place& u = places[i];
      out[i] = row[u.low] + u.share * (row[u.high] - row[u.low]) > kThreshold ? 1 : 0;
    }
  }
  return cropped(std::move(loose));
}

}  // namespace mms
