#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "mms/geometry/depth_noise.hpp"
#include "mms/localization/features/feature_cloud.hpp"

namespace mms {

/// Whether two images of a camera are the same apart from what moves, so that the camera stands
/// still. Blocks of the image vote by their textured static pixels, those of horizontal and of
/// vertical gradients apart; most must be unchanged for both, and most depths. False without enough
/// texture.
bool show_same_view(const IntensityLevel& before, const IntensityLevel& now,
                    const DepthNoise& noise);

/// Finds out where a camera stands still, and at which pose: a zero-velocity update (beyond the
/// paper). People without masks cannot move that pose.
class StillCamera {
 public:
  explicit StillCamera(const DepthNoise& noise) : noise_(noise) {}

  /// The pose of a camera that stood still and that the image shows to do so still; nothing if it
  /// moves, or is too far from the estimated pose.
  /// @param intensity  finest level first; may be empty
  std::optional<Eigen::Isometry3d> pose(const std::vector<IntensityLevel>& intensity,
                                        const Eigen::Isometry3d& estimated) const;

  /// Takes the image of a frame with its pose.
  void follow(const std::vector<IntensityLevel>& intensity,
              const Eigen::Isometry3d& T_world_sensor);

  void forget();  ///< all views

 private:
  struct View {
    IntensityLevel image;
    Eigen::Isometry3d T_world_sensor;
    int repeated = 0;  ///< frames after it with the same view
  };

  bool shows(const View& view, const std::vector<IntensityLevel>& intensity,
             const Eigen::Isometry3d& estimated) const;

  DepthNoise noise_;
  std::optional<View> latest_;  ///< the first of the frames that show the same view as the last one
  std::optional<View> stop_;    ///< where the camera stood still last
};

}  // namespace mms
