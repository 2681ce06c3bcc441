#include "mms/ros/mask_messages.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/io/image/rle.hpp"

namespace mms {
namespace {

/// Nearest-neighbor resampling.
Image<std::uint8_t> resized(const Image<std::uint8_t>& mask, int width, int height) {
  if (mask.width() == width && mask.height() == height) return mask;
  Image<std::uint8_t> result(width, height);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* row = mask.row(y * mask.height() / height);
    for (int x = 0; x < width; ++x) result(x, y) = row[x * mask.width() / width];
  }
  return result;
}

/// Crops the object from a mask of the whole image.
Instance instance_of(const Image<std::uint8_t>& mask) {
  int x_begin = mask.width();
  int x_end = 0;
  int y_begin = mask.height();
  int y_end = 0;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      if (mask(x, y) == 0) continue;
      x_begin = std::min(x_begin, x);
      x_end = std::max(x_end, x + 1);
      y_begin = std::min(y_begin, y);
      y_end = std::max(y_end, y + 1);
    }
  }
  Instance instance;
  if (x_begin >= x_end) return instance;
  instance.x = x_begin;
  instance.y = y_begin;
  instance.mask = Image<std::uint8_t>(x_end - x_begin, y_end - y_begin);
  for (int y = y_begin; y < y_end; ++y) {
    std::copy(mask.row(y) + x_begin, mask.row(y) + x_end, instance.mask.row(y - y_begin));
  }
  return instance;
}

}  // namespace

msg::Masks masks_message(const msg::Header& header, const Segmentation& segmentation) {
  msg::Masks message;
  message.header = header;
  message.width = static_cast<std::uint32_t>(segmentation.width);
  message.height = static_cast<std::uint32_t>(segmentation.height);
  for (const Instance& instance : segmentation.instances) {
    const Rle rle =
        encode_rle(instance.mask, instance.x, instance.y, segmentation.width, segmentation.height);
    message.instances.push_back(
        {static_cast<std::uint8_t>(instance.object_class), instance.score, rle_to_string(rle)});
  }
  return message;
}

Segmentation segmentation_of(const msg::Masks& message, int width, int height,
                             const std::string& where) {
  if (message.width == 0 || message.height == 0 || message.width > kMaxImageSide ||
      message.height > kMaxImageSide) {
    throw DataError(where, "masks of " + size_text(message.width, message.height) + " pixels");
  }
  Segmentation segmentation{width, height, {}};
  for (const msg::Instance& sent : message.instances) {
    if (sent.object_class >= kObjectClassCount) {
      throw DataError(where,
                      "has an object of the unknown class " + std::to_string(sent.object_class));
    }
    const Rle rle = rle_from_string(sent.mask, static_cast<int>(message.width),
                                    static_cast<int>(message.height));
    Instance instance = instance_of(resized(decode_rle(rle), width, height));
    if (instance.mask.empty()) continue;
    instance.object_class = static_cast<ObjectClass>(sent.object_class);
    instance.score = sent.score;
    segmentation.instances.push_back(std::move(instance));
  }
  return segmentation;
}

}  // namespace mms
