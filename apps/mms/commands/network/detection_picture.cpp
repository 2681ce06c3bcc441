#include "apps/mms/commands/network/detection_picture.hpp"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <ranges>

#include "mms/segmentation/segmenters/network_segmenter.hpp"

namespace mms {
namespace {

Rgb color_of(const std::string& name) {
  const auto meant = object_class_of(name);
  if (!meant) return {60, 120, 255};
  return *meant == ObjectClass::kPerson ? Rgb{255, 40, 40} : Rgb{30, 220, 60};
}

bool on_edge(const Image<std::uint8_t>& mask, int x, int y) {
  const auto outside = [&](int u, int v) { return !mask.contains(u, v) || mask(u, v) == 0; };
  return outside(x - 1, y) || outside(x + 1, y) || outside(x, y - 1) || outside(x, y + 1);
}

std::uint8_t half(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>((a + b) / 2);
}

void tint(const Detection& detection, const Rgb& color, Image<Rgb>& image) {
  for (int y = 0; y < detection.mask.height(); ++y) {
    for (int x = 0; x < detection.mask.width(); ++x) {
      if (detection.mask(x, y) == 0) continue;
      Rgb& pixel = image(detection.x + x, detection.y + y);
      pixel = on_edge(detection.mask, x, y)
                  ? color
                  : Rgb{half(pixel.r, color.r), half(pixel.g, color.g), half(pixel.b, color.b)};
    }
  }
}

void write_label(const Detection& detection, const std::string& name, const Rgb& color,
                 Image<Rgb>& image) {
  constexpr double kScale = 0.45;
  constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
  const std::string text = fmt::format("{} {:.2f}", name, detection.score);
  cv::Mat canvas(image.height(), image.width(), CV_8UC3, image.pixels().data());
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, kFont, kScale, 1, &baseline);
  const cv::Point corner(detection.x, std::max(size.height + 2, detection.y - 2));
  cv::rectangle(canvas, corner + cv::Point(0, 2), corner + cv::Point(size.width, -size.height - 2),
                cv::Scalar::all(0), cv::FILLED);
  cv::putText(canvas, text, corner, kFont, kScale, cv::Scalar(color.r, color.g, color.b), 1,
              cv::LINE_AA);
}

}  // namespace

Image<Rgb> draw_detections(const Image<Rgb>& image, const std::vector<Detection>& detections,
                           const std::vector<std::string>& classes) {
  Image<Rgb> picture = image;
  for (const Detection& detection : std::views::reverse(detections)) {
    tint(detection, color_of(classes[static_cast<std::size_t>(detection.category)]), picture);
  }
  for (const Detection& detection : std::views::reverse(detections)) {
    const std::string& name = classes[static_cast<std::size_t>(detection.category)];
    write_label(detection, name, color_of(name), picture);
  }
  return picture;
}

Image<std::uint8_t> label_image(int width, int height, const std::vector<Detection>& detections,
                                const std::vector<std::string>& classes) {
  Image<std::uint8_t> labels(width, height);
  for (const Detection& detection : std::views::reverse(detections)) {  // the surest one on top
    const auto meant = object_class_of(classes[static_cast<std::size_t>(detection.category)]);
    if (!meant) continue;
    for (int y = 0; y < detection.mask.height(); ++y) {
      for (int x = 0; x < detection.mask.width(); ++x) {
        if (detection.mask(x, y) == 0) continue;
        labels(detection.x + x, detection.y + y) =
            static_cast<std::uint8_t>(1 + static_cast<int>(*meant));
      }
    }
  }
  return labels;
}

}  // namespace mms
