#include "mms/segmentation/onnx/yolo_mask.hpp"

#include <algorithm>
#include <cmath>

namespace mms::onnx {
namespace {

constexpr float kThreshold = 0.5F;  // of a pixel's probability

/// Interpolation of a pixel of the image between prototype pixels.
struct Place {
  int low = 0;
  int high = 0;
  float share = 0.0F;  ///< weight of `high`
};

/// One axis of a mask: the pixels of the image from `first` on.
struct Axis {
  int first = 0;
  std::vector<Place> places;

  int length() const { return static_cast<int>(places.size()); }
  int low() const { return places.front().low; }
  int high() const { return places.back().high; }
};

/// The pixels whose centers are between `begin` and `end` [px of the input].
Axis axis_between(float begin, float end, const LetterboxAxis& letterbox, int prototypes) {
  const auto pixel = [&](float place) {
    const float within =
        std::clamp(letterbox.to_image(place), 0.0F, static_cast<float>(letterbox.image));
    return static_cast<int>(std::ceil(within - 0.5F));
  };
  const float step = static_cast<float>(prototypes) / static_cast<float>(letterbox.input);
  Axis axis{pixel(begin), {}};
  for (int i = axis.first; i < pixel(end); ++i) {
    const float at = letterbox.to_input(static_cast<float>(i) + 0.5F) * step - 0.5F;
    const float within = std::clamp(at, 0.0F, static_cast<float>(prototypes - 1));
    const int low = static_cast<int>(within);
    axis.places.push_back(
        {low, std::min(low + 1, prototypes - 1), within - static_cast<float>(low)});
  }
  return axis;
}

/// Probabilities of a rectangle of prototype pixels.
class SoftMask {
 public:
  SoftMask(const std::vector<float>& coefficients, const Prototypes& prototypes,
           const Axis& columns, const Axis& rows)
      : left_(columns.low()),
        top_(rows.low()),
        values_(columns.high() - left_ + 1, rows.high() - top_ + 1) {
    const float* plane = prototypes.values;
    for (const float coefficient : coefficients) {
      add(plane, coefficient, prototypes.width);
      plane += static_cast<std::ptrdiff_t>(prototypes.width) * prototypes.height;
    }
    for (float& value : values_.pixels()) value = 1.0F / (1.0F + std::exp(-value));
  }

  /// Bilinear.
  float at(const Place& u, const Place& v) const {
    const float* low = values_.row(v.low - top_);
    const float* high = values_.row(v.high - top_);
    const int left = u.low - left_;
    const int right = u.high - left_;
    const float a = low[left] + u.share * (low[right] - low[left]);
    const float b = high[left] + u.share * (high[right] - high[left]);
    return a + v.share * (b - a);
  }

 private:
  void add(const float* plane, float coefficient, int stride) {
    for (int y = 0; y < values_.height(); ++y) {
      const float* from = plane + static_cast<std::ptrdiff_t>(top_ + y) * stride + left_;
      float* to = values_.row(y);
      for (int x = 0; x < values_.width(); ++x) to[x] += coefficient * from[x];
    }
  }

  int left_ = 0;
  int top_ = 0;
  Image<float> values_;
};

/// Crops a mask to its non-zero part.
Detection cropped(const Detection& loose) {
  int left = loose.mask.width();
  int right = -1;
  int top = loose.mask.height();
  int bottom = -1;
  for (int y = 0; y < loose.mask.height(); ++y) {
    for (int x = 0; x < loose.mask.width(); ++x) {
      if (loose.mask(x, y) == 0) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = y;
    }
  }
  if (right < left) return {};
  Detection tight = loose;
  tight.x += left;
  tight.y += top;
  tight.mask = {right - left + 1, bottom - top + 1};
  for (int y = 0; y < tight.mask.height(); ++y) {
    std::copy_n(loose.mask.row(top + y) + left, tight.mask.width(), tight.mask.row(y));
  }
  return tight;
}

}  // namespace

Detection mask_in_box(const YoloBox& box, const std::vector<float>& coefficients,
                      const Prototypes& prototypes, const Letterbox& letterbox) {
  const Axis columns = axis_between(box.left, box.right, letterbox.x, prototypes.width);
  const Axis rows = axis_between(box.top, box.bottom, letterbox.y, prototypes.height);
  if (columns.places.empty() || rows.places.empty()) return {};  // in the padding
  const SoftMask soft(coefficients, prototypes, columns, rows);
  Detection loose{box.category, box.score, columns.first, rows.first, {}};
  loose.mask = {columns.length(), rows.length()};
  for (int y = 0; y < rows.length(); ++y) {
    const Place& row = rows.places[static_cast<std::size_t>(y)];
    for (int x = 0; x < columns.length(); ++x) {
      const Place& column = columns.places[static_cast<std::size_t>(x)];
      loose.mask(x, y) = soft.at(column, row) > kThreshold ? 1 : 0;
    }
  }
  return cropped(loose);
}

}  // namespace mms::onnx
