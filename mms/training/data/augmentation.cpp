#include "mms/training/data/augmentation.hpp"

#include <algorithm>
#include <cmath>

#include "mms/segmentation/solo/resize.hpp"

namespace mms {
namespace {

/// Rotation around an image's center.
struct Rotation {
  double angle;  ///< [rad]
  int width;     ///< [px]
  int height;

  /// Calls visit(x, y, from_x, from_y) for the pixels whose source is in the image.
  template <class Visit>
  void for_each_pixel(const Visit& visit) const {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double center_x = 0.5 * (width - 1);
    const double center_y = 0.5 * (height - 1);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double dx = x - center_x;
        const double dy = y - center_y;
        const auto from_x = static_cast<int>(std::floor(center_x + c * dx - s * dy + 0.5));
        const auto from_y = static_cast<int>(std::floor(center_y + s * dx + c * dy + 0.5));
        if (from_x >= 0 && from_y >= 0 && from_x < width && from_y < height) {
          visit(x, y, from_x, from_y);
        }
      }
    }
  }
};

/// Offset of an image on a canvas: 0 if it fits, else random and negative, which crops it.
int random_offset(int length, int canvas, RandomStream& random) {
  const int excess = length - canvas;
  if (excess <= 0) return 0;
  return -static_cast<int>(random.below(static_cast<std::size_t>(excess) + 1));
}

/// ImageNet's mean, which the network sees as zero.
constexpr Rgb kMeanColor = {124, 116, 104};

/// An object rotated like its image.
ObjectMask rotated(const ObjectMask& object, const Rotation& rotation) {
  ObjectMask canvas{
      object.category, object.crowd, 0, 0, Image<std::uint8_t>(rotation.width, rotation.height),
      object.box_only};
  rotation.for_each_pixel([&](int x, int y, int from_x, int from_y) {
    const int u = from_x - object.x;
    const int v = from_y - object.y;
    if (object.mask.contains(u, v)) canvas.mask(x, y) = object.mask(u, v);
  });
  return tightened(canvas);
}

/// Whether an object's mask is unknown; a rotated box is not that of the rotated object.
bool has_boxes(const Sample& sample) {
  return std::any_of(sample.objects.begin(), sample.objects.end(),
                     [](const ObjectMask& object) { return object.box_only; });
}

/// The sample rotated around its center, of the same size.
Sample rotated(const Sample& sample, double angle) {
  const Rotation rotation{angle, sample.width, sample.height};
  Sample result;
  result.width = sample.width;
  result.height = sample.height;
  result.partial = sample.partial;
  result.image = Image<Rgb>(sample.width, sample.height, kMeanColor);
  rotation.for_each_pixel([&](int x, int y, int from_x, int from_y) {
    result.image(x, y) = sample.image(from_x, from_y);
  });
  for (const ObjectMask& object : sample.objects) {
    ObjectMask turned = rotated(object, rotation);
    if (!turned.mask.empty()) result.objects.push_back(std::move(turned));
  }
  return result;
}

}  // namespace

Sample jittered(const Sample& upright, int width, int height, const AugmentationConfig& config,
                RandomStream& random) {
  const bool rolls =
      config.roll > 0.0 && random.chance(static_cast<float>(config.roll)) && !has_boxes(upright);
  const auto limit = static_cast<float>(config.roll_max * M_PI / 180.0);
  const Sample& sample = rolls ? rotated(upright, random.between(-limit, limit)) : upright;
  const bool flip = random.chance(static_cast<float>(config.flip));
  const double fit = std::min(static_cast<double>(width) / sample.width,
                              static_cast<double>(height) / sample.height);
  const double scale = fit * random.between(static_cast<float>(config.scale_min),
                                            static_cast<float>(config.scale_max));
  const int scaled_width = scaled_length(sample.width, scale);
  const int scaled_height = scaled_length(sample.height, scale);
  const int dx = random_offset(scaled_width, width, random);
  const int dy = random_offset(scaled_height, height, random);

  Sample result;
  result.partial = sample.partial;
  result.image = Image<Rgb>(width, height, kMeanColor);
  result.width = std::min(width, scaled_width);
  result.height = std::min(height, scaled_height);
  const int left = flip ? scaled_width + dx - result.width : -dx;  // of the part to be seen
  const Image<Rgb> part = resize_part(sample.image, scaled_width, scaled_height,
                                      {left, -dy, result.width, result.height});
  for (int y = 0; y < part.height(); ++y) {
    Rgb* row = result.image.row(y);
    flip ? std::reverse_copy(part.row(y), part.row(y) + part.width(), row)
         : std::copy_n(part.row(y), part.width(), row);
  }
  for (const ObjectMask& object : sample.objects) {
    ObjectMask moved = placed(object, {.scale = scale,
                                       .flip = flip,
                                       .source_width = sample.width,
                                       .dx = dx,
                                       .dy = dy,
                                       .width = result.width,
                                       .height = result.height});
    doubt_box(moved, mask_area(object.mask) * scale * scale);
    if (mask_area(moved.mask) >= kMinObjectPixels) result.objects.push_back(std::move(moved));
  }
  return result;
}

}  // namespace mms
