#include "mms/segmentation/solo/mask_upsampling.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

constexpr float kThreshold = 0.5F;
constexpr float kStride = 4.0F;  // input pixels per mask pixel

/// Interpolation positions of the image's pixels in the mask, along one axis.
class Axis {
 public:
  Axis(int picture, int valid, int mask) : picture_(picture), mask_(mask) {
    step_ = static_cast<float>(valid) / static_cast<float>(picture) / kStride;
  }

  struct Place {
    int low = 0;
    int high = 0;
    float share = 0.0F;  ///< weight of `high`
  };

  /// Of the pixels first..last.
  std::vector<Place> places(int first, int last) const {
    std::vector<Place> all;
    for (int pixel = first; pixel <= last; ++pixel) all.push_back(place(pixel));
    return all;
  }

  /// Image pixels that may depend on the mask pixels first..last: inclusive range.
  std::pair<int, int> reach(int first, int last) const {
    const auto pixel = [&](float at) { return (at + 0.5F) / step_ - 0.5F; };
    const int low = static_cast<int>(std::floor(pixel(static_cast<float>(first - 1))));
    const int high = static_cast<int>(std::ceil(pixel(static_cast<float>(last + 1))));
    return {first == 0 ? 0 : std::max(0, low), std::min(picture_ - 1, high)};
  }

 private:
  Place place(int pixel) const {
    const float at = (static_cast<float>(pixel) + 0.5F) * step_ - 0.5F;
    const float within = std::clamp(at, 0.0F, static_cast<float>(mask_ - 1));
    const int low = static_cast<int>(within);
    return {low, std::min(low + 1, mask_ - 1), within - static_cast<float>(low)};
  }

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

/// Bounding box of the values that count, in rows of `width`.
template <class Value, class Counts>
Box bounds(const std::vector<Value>& values, int width, const Counts& counts) {
  const auto row_of = [&](int y) { return values.data() + static_cast<std::ptrdiff_t>(y) * width; };
  const auto has_some = [&](int y) { return std::any_of(row_of(y), row_of(y) + width, counts); };
  Box box{width, -1, 0, static_cast<int>(values.size()) / width - 1};
  while (box.top <= box.bottom && !has_some(box.top)) ++box.top;
  while (box.top < box.bottom && !has_some(box.bottom)) --box.bottom;
  for (int y = box.top; y <= box.bottom; ++y) {  // skips pixels that cannot extend the box
    const Value* row = row_of(y);
    box.left = static_cast<int>(std::find_if(row, row + box.left, counts) - row);
    int right = width - 1;
    while (right > box.right && !counts(row[right])) --right;
    box.right = right;
  }
  return box;
}

/// The rows first..last of a mask, interpolated at the image's columns.
Image<float> widened_rows(const std::vector<float>& soft, int mask_width, int first, int last,
                          const std::vector<Axis::Place>& columns) {
  Image<float> rows(static_cast<int>(columns.size()), last - first + 1);
  for (int y = first; y <= last; ++y) {
    const float* row = soft.data() + static_cast<std::ptrdiff_t>(y) * mask_width;
    float* out = rows.row(y - first);
    for (const Axis::Place& u : columns) *out++ = row[u.low] + u.share * (row[u.high] - row[u.low]);
  }
  return rows;
}

/// Thresholds the interpolation between two rows of probabilities.
void cut_between(const float* low, const float* high, float share, int width, std::uint8_t* out) {
  for (int x = 0; x < width; ++x) {
    out[x] = low[x] + share * (high[x] - low[x]) > kThreshold ? 1 : 0;
  }
}

/// The mask, interpolated at the given positions.
Image<std::uint8_t> mask_at(const std::vector<float>& soft, int mask_width,
                            const std::vector<Axis::Place>& columns,
                            const std::vector<Axis::Place>& rows) {
  const int first = rows.front().low;
  const Image<float> wide = widened_rows(soft, mask_width, first, rows.back().high, columns);
  Image<std::uint8_t> mask(wide.width(), static_cast<int>(rows.size()));
  for (int y = 0; y < mask.height(); ++y) {
    const Axis::Place& v = rows[static_cast<std::size_t>(y)];
    cut_between(wide.row(v.low - first), wide.row(v.high - first), v.share, mask.width(),
                mask.row(y));
  }
  return mask;
}

/// Crops a detection to the rows and columns of its mask.
Detection cropped(const Detection& loose) {
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

Detection upsampled_mask(const std::vector<float>& soft, int mask_width,
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
  loose.mask = mask_at(soft, mask_width, columns.places(left, right), rows.places(top, bottom));
  return cropped(loose);
}

}  // namespace mms
