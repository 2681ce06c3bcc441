#include "mms/fusion/clouds/mask_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "mms/core/error.hpp"

namespace mms {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

void check(const Segmentation& segmentation, int width, int height) {
  if (!is_computed(segmentation)) return;
  if (segmentation.width == width && segmentation.height == height) return;
  throw DataError("segmentation",
                  "masks are " + size_text(segmentation.width, segmentation.height) +
                      " px, the image is " + size_text(width, height) + " px",
                  "use the masks of this recording, at its resolution");
}

/// Sets the blocks under `instance` to `value`; parts outside the image are cut off.
void draw(const Instance& instance, std::uint16_t value, int stride, Image<std::uint16_t>& image) {
  const Image<std::uint8_t>& mask = instance.mask;
  const int x_begin = std::max(0, -instance.x);
  const int x_end = std::min(mask.width(), image.width() * stride - instance.x);
  const int y_begin = std::max(0, -instance.y);
  const int y_end = std::min(mask.height(), image.height() * stride - instance.y);
  std::vector<int> column(static_cast<std::size_t>(mask.width()));
  for (int x = 0; x < mask.width(); ++x) {
    column[static_cast<std::size_t>(x)] = (instance.x + x) / stride;
  }
  for (int y = y_begin; y < y_end; ++y) {
    const std::uint8_t* from = mask.row(y);
    std::uint16_t* to = image.row((instance.y + y) / stride);
    for (int x = x_begin; x < x_end; ++x) {
      if (from[x] != 0) to[column[static_cast<std::size_t>(x)]] = value;
    }
  }
}

/// Indices of the instances, lowest score first; of equal scores the latest first.
std::vector<std::size_t> drawing_order(const std::vector<Instance>& instances) {
  std::vector<std::size_t> order(instances.size());
  std::iota(order.rbegin(), order.rend(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return instances[a].score < instances[b].score;
  });
  return order;
}

cv::Mat as_mat(Image<std::uint16_t>& image) {
  return {image.height(), image.width(), CV_16UC1, image.pixels().data()};
}

cv::Mat disc(int radius) {
  const int side = 2 * radius + 1;
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(side, side));
}

/// `raw` dilated by a disc of `radius`; pixels of an instance keep its value.
Image<std::uint16_t> dilated(Image<std::uint16_t>& raw, int radius) {
  Image<std::uint16_t> dilated(raw.width(), raw.height());
  cv::Mat target = as_mat(dilated);
  cv::dilate(as_mat(raw), target, disc(radius));
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] != 0) dilated[i] = raw[i];
  }
  return dilated;
}

}  // namespace

MaskImage make_mask_image(const Segmentation& segmentation, int width, int height, int stride,
                          double dilation) {
  check(segmentation, width, height);
  constexpr std::size_t kMaxInstances = std::numeric_limits<std::int16_t>::max();
  if (segmentation.instances.size() > kMaxInstances) {
    throw DataError("segmentation", std::to_string(segmentation.instances.size()) +
                                        " instances, allowed: up to 32767");
  }
  for (const Instance& instance : segmentation.instances) {
    if (static_cast<int>(instance.object_class) < kObjectClassCount) continue;
    throw DataError("segmentation", "an instance is of unknown class", "give person or agv");
  }
  MaskImage image;
  image.raw = Image<std::uint16_t>(width / stride, height / stride);
  for (const std::size_t i : drawing_order(segmentation.instances)) {
    draw(segmentation.instances[i], static_cast<std::uint16_t>(i + 1), stride, image.raw);
  }
  image.radius = static_cast<int>(std::lround(dilation * width / stride));
  const bool grows = image.radius > 0 && !segmentation.instances.empty();
  image.dilated = grows ? dilated(image.raw, image.radius) : image.raw;
  return image;
}

void dilate(Image<std::uint8_t>& image, int radius) {
  cv::Mat mat(image.height(), image.width(), CV_8UC1, image.pixels().data());
  cv::dilate(mat, mat, disc(radius));
}

}  // namespace mms
