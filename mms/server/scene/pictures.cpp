#include "mms/server/scene/pictures.hpp"

#include <algorithm>

#include "mms/io/image/image_io.hpp"

namespace mms {
namespace {

constexpr int kJpegQuality = 75;
constexpr Rgb kUncoloredPoint{160, 160, 160};

Rgb mean_of_square(const Image<Rgb>& image, int left, int top, int side) {
  int r = 0;
  int g = 0;
  int b = 0;
  for (int y = top; y < top + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      const Rgb& pixel = image(x, y);
      r += pixel.r;
      g += pixel.g;
      b += pixel.b;
    }
  }
  const int count = side * side;
  return {static_cast<std::uint8_t>(r / count), static_cast<std::uint8_t>(g / count),
          static_cast<std::uint8_t>(b / count)};
}

constexpr std::uint8_t value_of(ObjectClass object_class) {
  return static_cast<std::uint8_t>(1 + static_cast<int>(object_class));
}

/// Value of a dynamic point of a known object; else 0.
std::uint8_t known_value(const LabeledCloud& cloud, std::size_t i) {
  if (cloud.labels[i] != PointLabel::kDynamic || cloud.cluster.empty()) return 0;
  const auto cluster = static_cast<std::size_t>(cloud.cluster[i]);
  return cloud.cluster[i] >= 0 && cluster < cloud.clusters.size()
             ? value_of(cloud.clusters[cluster].object_class)
             : std::uint8_t{0};
}

bool is_dynamic(const LabeledCloud& cloud, std::size_t i) {
  return cloud.labels[i] == PointLabel::kDynamic ||
         (!cloud.dynamic_pixels.empty() && cloud.dynamic_pixels[i] != 0);
}

/// Propagates the values over the dynamic pixels, nearest first.
void spread(const LabeledCloud& cloud, Image<std::uint8_t>& mask) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] != 0) front.push_back(i);
  }
  const auto width = static_cast<std::size_t>(mask.width());
  for (std::size_t next = 0; next < front.size(); ++next) {
    const std::size_t i = front[next];
    const auto reach = [&](bool there, std::size_t neighbour) {
      if (!there || mask[neighbour] != 0 || !is_dynamic(cloud, neighbour)) return;
      mask[neighbour] = mask[i];
      front.push_back(neighbour);
    };
    reach(i % width > 0, i - 1);
    reach(i % width + 1 < width, i + 1);
    reach(i >= width, i - width);
    reach(i + width < mask.size(), i + width);
  }
}

}  // namespace

Image<Rgb> shrunk(const Image<Rgb>& image, int max_width) {
  const int side = (image.width() + max_width - 1) / max_width;
  if (side <= 1) return image;
  Image<Rgb> small(image.width() / side, std::max(1, image.height() / side));
  if (image.height() < side) return image;
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      small(x, y) = mean_of_square(image, x * side, y * side, side);
    }
  }
  return small;
}

Image<std::uint8_t> mask_of(const LabeledCloud& cloud) {
  if (!cloud.organised()) return {};
  Image<std::uint8_t> mask(cloud.width, cloud.height);
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = known_value(cloud, i);
  spread(cloud, mask);
  // The rest are masks without points, whose class is unknown.
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0 && is_dynamic(cloud, i)) mask[i] = value_of(ObjectClass::kPerson);
  }
  for (std::size_t i = 0; i < cloud.overruled.size(); ++i) {
    if (cloud.overruled[i] != 0) mask[i] = kOverruledMask;
  }
  return mask;
}

ColoredPoints scan_points(const LabeledCloud& cloud, std::size_t max_points,
                          std::vector<std::uint8_t>& dynamic) {
  const auto valid = static_cast<std::size_t>(
      std::count_if(cloud.labels.begin(), cloud.labels.end(),
                    [](PointLabel label) { return label != PointLabel::kInvalid; }));
  ColoredPoints points;
  dynamic.clear();
  // Bresenham's algorithm selects max_points of the valid points evenly.
  std::size_t error = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] == PointLabel::kInvalid) continue;
    error += std::min(max_points, valid);
    if (error < valid) continue;
    error -= valid;
    points.points.push_back(cloud.points[i]);
    points.colors.push_back(cloud.colors.empty() ? kUncoloredPoint : cloud.colors[i]);
    dynamic.push_back(cloud.labels[i] == PointLabel::kDynamic ? 1 : 0);
  }
  return points;
}

EncodedPictures encode_pictures(const SensorView& view) {
  EncodedPictures pictures;
  pictures.frame = view.frame;
  pictures.points = scan_points(view.cloud, kMaxScanPoints, pictures.dynamic);
  if (!view.color.empty()) {
    pictures.jpeg = encode_jpeg(shrunk(view.color, kMaxImageWidth), kJpegQuality);
  }
  const Image<std::uint8_t> mask = mask_of(view.cloud);
  if (!mask.empty()) pictures.mask_png = encode_png(mask);
  return pictures;
}

}  // namespace mms
