#include "mms/fusion/clouds/depth_cloud.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "mms/core/error.hpp"
#include "mms/geometry/camera.hpp"

namespace mms {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// [m]: depth step between two surfaces in a block, noise apart.
/// Source: initial choice; a floor at grazing incidence (80 degrees) has 2 cm a pixel at 2 m, with
/// a focal length of 525 px.
constexpr float kSurfaceStep = 0.02F;

/// [-]: depth noise added to it, in sigmas. Source: three-sigma rule.
constexpr float kSurfaceSigmas = 3.0F;

void check_size(const Frame& frame, const std::string& what, int width, int height) {
  if (width == frame.depth.width() && height == frame.depth.height()) return;
  throw DataError("frame " + frame.name,
                  what + " is " + std::to_string(width) + " x " + std::to_string(height) +
                      " px, depth is " + std::to_string(frame.depth.width()) + " x " +
                      std::to_string(frame.depth.height()) + " px",
                  "depth must be registered to the color image");
}

void check(const Frame& frame) {
  if (!frame.calibration->camera) {
    throw DataError("frame " + frame.name, "a depth image without camera intrinsics",
                    "give fx fy cx cy width height in calibration.yaml");
  }
  const CameraIntrinsics& camera = *frame.calibration->camera;
  check_size(frame, "the calibrated image", camera.width, camera.height);
  if (!frame.color.empty()) {
    check_size(frame, "color", frame.color.width(), frame.color.height());
  }
}

/// Mean of a block's returns. Where some are missing it lies beside the block's center, which on a
/// slanted surface changes the depth by centimeters.
struct Return {
  float depth = 0.0F;  ///< [m], 0 for none
  float u = 0.0F;      ///< from the block's center [px of the full image]
  float v = 0.0F;
};

/// Sums and reads of one block of pixels; Stride 0 stands for one known at run time only.
template <int Stride>
class Block {
 public:
  Block(const FusionConfig& config, int stride)
      : stride_(stride),
        min_(static_cast<float>(config.min_range)),
        max_(static_cast<float>(config.max_range)),
        noise_(config.noise.depth) {}

  int stride() const { return Stride > 0 ? Stride : stride_; }

  /// Mean of the nearest surface's returns in the block at (x, y) of the cloud.
  Return nearest_surface(const Image<float>& image, int x, int y) const {
    float nearest = kInfinity;
    float farthest = 0.0F;
    for_each(image, x, y, [&](float z, int, int) {
      const bool is_return = z >= min_ && z <= max_;
      nearest = is_return && z < nearest ? z : nearest;
      farthest = is_return && z > farthest ? z : farthest;
    });
    if (farthest == 0.0F) return {};
    if (farthest - nearest > kSurfaceStep) {
      farthest = std::min(farthest, nearest + surface_step(nearest));
    }
    Return sum;
    float count = 0.0F;
    for_each(image, x, y, [&](float z, int u, int v) {
      const float used = z >= nearest && z <= farthest ? 1.0F : 0.0F;
      sum.depth += used * z;
      sum.u += used * static_cast<float>(u);
      sum.v += used * static_cast<float>(v);
      count += used;
    });
    const float center = 0.5F * static_cast<float>(stride() - 1);
    return {sum.depth / count, sum.u / count - center, sum.v / count - center};
  }

  Rgb color(const Image<Rgb>& image, int x, int y) const {
    int sum[3] = {0, 0, 0};
    for_each(image, x, y, [&](const Rgb& c, int, int) {
      sum[0] += c.r;
      sum[1] += c.g;
      sum[2] += c.b;
    });
    const int count = stride() * stride();
    const auto mean = [&](int s) { return static_cast<std::uint8_t>((s + count / 2) / count); };
    return {mean(sum[0]), mean(sum[1]), mean(sum[2])};
  }

 private:
  template <class T, class Visit>
  void for_each(const Image<T>& image, int x, int y, const Visit& visit) const {
    for (int v = 0; v < stride(); ++v) {
      const T* row = image.row(y * stride() + v) + x * stride();
      for (int u = 0; u < stride(); ++u) visit(row[u], u, v);
    }
  }

  float surface_step(float z) const { return kSurfaceStep + kSurfaceSigmas * noise_.sigma(z); }

  int stride_;
  float min_;
  float max_;
  DepthNoise noise_;
};

template <int Stride>
void fill_cloud(const Frame& frame, const Block<Stride>& block,
                const std::vector<Eigen::Vector3f>& rays, LabeledCloud& cloud) {
  const CameraIntrinsics& full = *frame.calibration->camera;
  const Eigen::Vector2f per_pixel(static_cast<float>(1.0 / full.fx),
                                  static_cast<float>(1.0 / full.fy));
  std::size_t i = 0;
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x, ++i) {
      if (!cloud.colors.empty()) cloud.colors[i] = block.color(frame.color, x, y);
      const Return mean = block.nearest_surface(frame.depth, x, y);
      if (mean.depth == 0.0F) continue;
      const Eigen::Vector3f aside(mean.u * per_pixel.x(), mean.v * per_pixel.y(), 0.0F);
      cloud.points[i] = (rays[i] + aside) * mean.depth;
      cloud.labels[i] = PointLabel::kStatic;
    }
  }
}

}  // namespace

void DepthCloudBuilder::prepare(const CameraIntrinsics& camera) {
  if (camera == full_camera_ && !ray_table_.empty()) return;
  full_camera_ = camera;
  stride_ = config_.stride_of(camera);
  camera_ = downscaled(camera, stride_);
  ray_table_ = CameraModel(camera_).ray_table();
}

LabeledCloud DepthCloudBuilder::build(const Frame& frame) {
  check(frame);
  prepare(*frame.calibration->camera);
  LabeledCloud cloud;
  cloud.stamp = frame.stamp;
  cloud.points_offset = frame.depth_offset;
  cloud.width = camera_.width;
  cloud.height = camera_.height;
  cloud.camera = camera_;
  cloud.points.assign(ray_table_.size(), Eigen::Vector3f::Constant(kNan));
  cloud.labels.assign(ray_table_.size(), PointLabel::kInvalid);
  cloud.cluster.assign(ray_table_.size(), std::int16_t{-1});
  cloud.colors.resize(frame.color.empty() ? 0 : ray_table_.size());
  cloud.dynamic_pixels = Image<std::uint8_t>(cloud.width, cloud.height);
  if (stride_ == 2) {
    fill_cloud(frame, Block<2>(config_, stride_), ray_table_, cloud);
  } else {
    fill_cloud(frame, Block<0>(config_, stride_), ray_table_, cloud);
  }
  return cloud;
}

}  // namespace mms
