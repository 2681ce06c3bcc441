#include "mms/segmentation/solo/prepared_image.hpp"

#include <algorithm>
#include <array>

#include "mms/segmentation/solo/resize.hpp"

namespace mms {
namespace {

constexpr int kMaxStride = 32;
constexpr int kMinSide = 96;  // SAC uses 5x5 pixels of the coarsest map
constexpr std::array<float, 3> kMean = {123.675F, 116.28F, 103.53F};  // of ImageNet, r g b
constexpr std::array<float, 3> kDeviation = {58.395F, 57.12F, 57.375F};

}  // namespace

int padded_length(int length) {
  const int multiple = (length + kMaxStride - 1) / kMaxStride * kMaxStride;
  return std::max(kMinSide, multiple);
}

void normalise(const Image<Rgb>& image, int width, int height, int plane_width, int plane_height,
               float* planes) {
  const std::size_t plane =
      static_cast<std::size_t>(plane_width) * static_cast<std::size_t>(plane_height);
  for (int y = 0; y < height; ++y) {
    const Rgb* row = image.row(y);
    float* out = planes + static_cast<std::size_t>(y) * static_cast<std::size_t>(plane_width);
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(x);
      out[i] = (static_cast<float>(row[x].r) - kMean[0]) / kDeviation[0];
      out[plane + i] = (static_cast<float>(row[x].g) - kMean[1]) / kDeviation[1];
      out[2 * plane + i] = (static_cast<float>(row[x].b) - kMean[2]) / kDeviation[2];
    }
  }
}

PreparedImage prepare_image(const Image<Rgb>& image, const NetworkConfig& config) {
  const double scale =
      fitting_scale(image.width(), image.height(), config.long_side, config.short_side);
  PreparedImage prepared;
  prepared.image_width = image.width();
  prepared.image_height = image.height();
  prepared.valid_width = scaled_length(image.width(), scale);
  prepared.valid_height = scaled_length(image.height(), scale);
  prepared.width = padded_length(prepared.valid_width);
  prepared.height = padded_length(prepared.valid_height);
  prepared.planes.assign(
      3 * static_cast<std::size_t>(prepared.width) * static_cast<std::size_t>(prepared.height),
      0.0F);
  normalise(resize(image, prepared.valid_width, prepared.valid_height), prepared.valid_width,
            prepared.valid_height, prepared.width, prepared.height, prepared.planes.data());
  return prepared;
}

}  // namespace mms
