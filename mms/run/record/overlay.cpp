#include "mms/run/record/overlay.hpp"

namespace mms {
namespace {

std::uint8_t mix(std::uint8_t color, int other, int percent) {
  return static_cast<std::uint8_t>((color * (100 - percent) + other * percent) / 100);
}

Rgb tinted(const Rgb& c) {
  return {mix(c.r, 255, 55), mix(c.g, 30, 55), mix(c.b, 30, 55)};
}
Rgb tinted_blue(const Rgb& c) {
  return {mix(c.r, 30, 55), mix(c.g, 90, 55), mix(c.b, 255, 55)};
}
Rgb dimmed(const Rgb& c) {
  return {mix(c.r, 0, 60), mix(c.g, 0, 60), mix(c.b, 0, 60)};
}

}  // namespace

Image<Rgb> draw_overlay(const LabeledCloud& cloud) {
  Image<Rgb> picture(cloud.width, cloud.height);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const Rgb color = cloud.colors.empty() ? Rgb{160, 160, 160} : cloud.colors[i];
    const bool dynamic = cloud.labels[i] == PointLabel::kDynamic ||
                         (!cloud.dynamic_pixels.empty() && cloud.dynamic_pixels[i] != 0);
    const bool missing = cloud.labels[i] == PointLabel::kInvalid;
    const bool overruled = !cloud.overruled.empty() && cloud.overruled[i] != 0;
    picture[i] = overruled ? tinted_blue(color)
                 : dynamic ? tinted(color)
                 : missing ? dimmed(color)
                           : color;
  }
  return picture;
}

}  // namespace mms
