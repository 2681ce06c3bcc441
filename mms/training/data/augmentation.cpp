#include "mms/training/data/augmentation.hpp"

#include <algorithm>
#include <cmath>

#include "mms/segmentation/solo/resize.hpp"

namespace mms {
namespace {

Image<Rgb> mirrored(const Image<Rgb>& image) {
  Image<Rgb> result(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    std::reverse_copy(image.row(y), image.row(y) + image.width(), result.row(y));
  }
  return result;
}

/// Copies the part of `scaled` at (dx, dy) that overlaps the canvas.
void lay(const Image<Rgb>& scaled, int dx, int dy, Image<Rgb>& canvas) {
  const int width = std::min(canvas.width(), scaled.width() + dx);
  const int height = std::min(canvas.height(), scaled.height() + dy);
  for (int y = 0; y < height; ++y) std::copy_n(scaled.row(y - dy) - dx, width, canvas.row(y));
}

/// Offset of an image on a canvas: 0 if it fits, else random and negative, which crops it.
int random_offset(int length, int canvas, RandomStream& random) {
  const int excess = length - canvas;
  if (excess <= 0) return 0;
  return -static_cast<int>(random.below(static_cast<std::size_t>(excess) + 1));
}

}  // namespace

Sample jittered(const Sample& sample, int width, int height, const AugmentationConfig& config,
                RandomStream& random) {
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
  result.image = Image<Rgb>(width, height);
  result.width = std::min(width, scaled_width);
  result.height = std::min(height, scaled_height);
  const Image<Rgb> scaled = resize(sample.image, scaled_width, scaled_height);
  lay(flip ? mirrored(scaled) : scaled, dx, dy, result.image);
  for (const ObjectMask& object : sample.objects) {
    ObjectMask moved = placed(object, {.scale = scale,
                                       .flip = flip,
                                       .source_width = sample.width,
                                       .dx = dx,
                                       .dy = dy,
                                       .width = result.width,
                                       .height = result.height});
    if (mask_area(moved.mask) >= kMinObjectPixels) result.objects.push_back(std::move(moved));
  }
  return result;
}

}  // namespace mms
