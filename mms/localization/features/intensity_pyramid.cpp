#include "mms/localization/features/intensity_pyramid.hpp"

#include <algorithm>
#include <array>

#include "mms/geometry/camera.hpp"

namespace mms {
namespace {

/// [px]: smallest width and height of a level.
/// Source: initial choice; after the borders 12 px are left, 16 textured cells of 3 px.
constexpr int kMinSide = 16;

/// [-]: depth step between surfaces in a block of 2 x 2 pixels, over the depth.
/// Source: three sigma of a Kinect's depth noise at 4 m (2 %) and a 63 degree slope over one pixel
/// of the second level (1.5 %, focal length 131 px), rounded up.
constexpr float kMaxDepthStep = 0.05F;

/// ITU-R BT.601 luma.
float luminance(const Rgb& c) {
  return 0.299F * static_cast<float>(c.r) + 0.587F * static_cast<float>(c.g) +
         0.114F * static_cast<float>(c.b);
}

void differentiate(Image<IntensitySample>& image) {
  const int last_x = image.width() - 1;
  const int last_y = image.height() - 1;
  for (int y = 0; y <= last_y; ++y) {
    const IntensitySample* above = image.row(std::max(0, y - 1));
    const IntensitySample* below = image.row(std::min(last_y, y + 1));
    IntensitySample* row = image.row(y);
    for (int x = 0; x <= last_x; ++x) {
      row[x].dx = 0.5F * (row[std::min(last_x, x + 1)].value - row[std::max(0, x - 1)].value);
      row[x].dy = 0.5F * (below[x].value - above[x].value);
    }
  }
}

/// Mean of the static depths of a block that belong to its nearest surface, 0 without any.
float block_depth(const std::array<float, 4>& depths) {
  float nearest = 0.0F;
  for (const float d : depths) {
    if (d > 0.0F && (nearest == 0.0F || d < nearest)) nearest = d;
  }
  float sum = 0.0F;
  float count = 0.0F;
  for (const float d : depths) {
    if (d > 0.0F && d <= nearest * (1.0F + kMaxDepthStep)) {
      sum += d;
      count += 1.0F;
    }
  }
  return count > 0.0F ? sum / count : 0.0F;
}

IntensityLevel finest_level(const LabeledCloud& cloud) {
  IntensityLevel level{cloud.camera, Image<IntensitySample>(cloud.width, cloud.height),
                       Image<float>(cloud.width, cloud.height, 0.0F)};
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    level.intensity[i].value = luminance(cloud.colors[i]);
    if (cloud.labels[i] == PointLabel::kStatic) level.depth[i] = cloud.points[i].z();
  }
  differentiate(level.intensity);
  return level;
}

IntensityLevel half_size(const IntensityLevel& fine) {
  const CameraIntrinsics camera = downscaled(fine.camera, 2);
  IntensityLevel level{camera, Image<IntensitySample>(camera.width, camera.height),
                       Image<float>(camera.width, camera.height, 0.0F)};
  for (int y = 0; y < camera.height; ++y) {
    const IntensitySample* a = fine.intensity.row(2 * y);
    const IntensitySample* b = fine.intensity.row(2 * y + 1);
    const float* da = fine.depth.row(2 * y);
    const float* db = fine.depth.row(2 * y + 1);
    for (int x = 0; x < camera.width; ++x) {
      const int l = 2 * x;
      level.intensity(x, y).value =
          0.25F * (a[l].value + a[l + 1].value + b[l].value + b[l + 1].value);
      level.depth(x, y) = block_depth({da[l], da[l + 1], db[l], db[l + 1]});
    }
  }
  differentiate(level.intensity);
  return level;
}

Image<std::uint8_t> half_size(const Image<std::uint8_t>& fine, const CameraIntrinsics& camera) {
  Image<std::uint8_t> half(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    const std::uint8_t* a = fine.row(2 * y);
    const std::uint8_t* b = fine.row(2 * y + 1);
    for (int x = 0; x < camera.width; ++x) {
      half(x, y) = a[2 * x] | a[2 * x + 1] | b[2 * x] | b[2 * x + 1];
    }
  }
  return half;
}

/// Removes the depth of the pixels whose color or gradient includes a dynamic pixel.
void clear_depth(const Image<std::uint8_t>& dynamic, Image<float>& depth) {
  for (int y = 0; y < dynamic.height(); ++y) {
    for (int x = 0; x < dynamic.width(); ++x) {
      if (dynamic(x, y) == 0) continue;
      for (int v = std::max(0, y - 1); v <= std::min(y + 1, depth.height() - 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(x + 1, depth.width() - 1); ++u) {
          depth(u, v) = 0.0F;
        }
      }
    }
  }
}

}  // namespace

std::vector<IntensityLevel> build_intensity_pyramid(const LabeledCloud& cloud, int levels) {
  std::vector<IntensityLevel> pyramid;
  pyramid.push_back(finest_level(cloud));
  while (static_cast<int>(pyramid.size()) < levels) {
    const CameraIntrinsics& last = pyramid.back().camera;
    if (last.width < 2 * kMinSide || last.height < 2 * kMinSide) break;
    pyramid.push_back(half_size(pyramid.back()));
  }
  keep_clear(cloud.dynamic_pixels, pyramid);
  return pyramid;
}

void keep_clear(Image<std::uint8_t> dynamic, std::vector<IntensityLevel>& pyramid) {
  for (IntensityLevel& level : pyramid) {
    if (&level != &pyramid.front()) dynamic = half_size(dynamic, level.camera);
    clear_depth(dynamic, level.depth);
  }
}

}  // namespace mms
