#pragma once

#include <Eigen/Core>

#include "mms/core/config_visitor.hpp"
#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/camera.hpp"
#include "mms/geometry/depth_noise.hpp"
#include "mms/mapping/free_space/space_state.hpp"

namespace mms {

struct CarvingConfig {
  bool enabled = true;
  double margin = 0.03;  ///< [m]
  double ratio = 0.5;
  double scan_margin = 0.15;  ///< [m]
  double scan_ratio = 0.5;

  void visit(ConfigVisitor& v) {
    v.boolean({"enabled", "",
               "remove voxels that later keyframes see through, leave out points of scans that "
               "recent ones did"},
              enabled);
    v.number({"margin", "m", "least distance of the measured surface behind, above noise"}, margin,
             {0.0, 10.0});
    v.number({"ratio", "", "views through a voxel per hit that remove it"}, ratio, {0.1, 1000.0});
    v.number({"scan_margin", "m", "margin of LiDAR scans, noise included"}, scan_margin,
             {0.01, 10.0});
    v.number({"scan_ratio", "", "ratio of LiDAR scans"}, scan_ratio, {0.1, 1000.0});
  }
};

/// The space that one organised cloud observes as free: in front of its measured points, static or
/// dynamic. A pixel counts only where it and its eight neighbours have a depth, and with the
/// nearest of them, so that holes and the boundaries of objects carve nothing.
class FreeSpace {
 public:
  /// The points that are used.
  enum class Returns { kAll, kStatic };

  /// @param margin  by which a point has to lie before another, above noise [m]
  FreeSpace(const LabeledCloud& cloud, double margin, const DepthNoise& noise,
            Returns returns = Returns::kAll);

  /// True where the measured surface is clearly behind `point` (sensor frame [m]).
  bool sees_through(const Eigen::Vector3f& point) const;

  /// What was observed at `point` (sensor frame [m]); never kNone.
  SpaceState state_at(const Eigen::Vector3f& point) const;

  /// False where no point of the ball (sensor frame [m]) can be seen through; cheap.
  bool may_see_into(const Eigen::Vector3f& center, float radius) const;

 private:
  Eigen::Vector2f pixel_of(const Eigen::Vector3f& point) const;
  float depth_at(const Eigen::Vector3f& point) const;
  /// One sigma is enough: the nearest of nine pixels lies about 1.5 sigma before the surface.
  float needed_depth(float z) const { return z + margin_ + noise_.sigma(z); }

  CameraModel camera_;
  bool distorted_;
  Eigen::Array2f focal_;   // of a camera without distortion, in single precision [px]
  Eigen::Array2f center_;  // [px]
  float margin_;
  DepthNoise noise_;
  Image<float> nearest_;   // of 3 x 3 pixels [m], 0 where any has none
  Image<float> farthest_;  // of `nearest_` in kTileSize x kTileSize pixels
};

}  // namespace mms
