#include "mms/dataset/source/depth_file.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

#include "mms/io/image/image_io.hpp"
#include "mms/io/image/npy_io.hpp"

namespace mms {
namespace {

Image<float> to_metres(const Image<std::uint16_t>& raw, double scale, std::uint16_t invalid) {
  Image<float> depth(raw.width(), raw.height());
  const float units = static_cast<float>(scale);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    depth[i] = raw[i] == invalid ? 0.0F : static_cast<float>(raw[i]) / units;
  }
  return depth;
}

Image<float> to_metres(Image<float> depth, double scale) {
  const float units = static_cast<float>(scale);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const bool valid = std::isfinite(depth[i]) && depth[i] > 0.0F;
    depth[i] = valid ? depth[i] / units : 0.0F;
  }
  return depth;
}

}  // namespace

Image<float> read_depth(const std::filesystem::path& path, double scale, std::uint16_t invalid,
                        double float_scale) {
  StoredDepth stored = path.extension() == ".npy" ? read_npy(path) : read_stored_depth(path);
  if (auto* numbers = std::get_if<Image<float>>(&stored)) {
    return to_metres(std::move(*numbers), float_scale);
  }
  return to_metres(std::get<Image<std::uint16_t>>(stored), scale, invalid);
}

}  // namespace mms
