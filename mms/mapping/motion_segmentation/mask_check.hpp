#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/geometry/depth_noise.hpp"
#include "mms/mapping/free_space/free_space.hpp"
#include "mms/mapping/free_space/free_space_history.hpp"
#include "mms/mapping/motion_segmentation/mask_check_config.hpp"
#include "mms/mapping/motion_segmentation/place_views.hpp"

namespace mms {

/// What recent views tell of the points of one frame, seen from one pose.
struct MaskEvidence {
  /// Non-zero at dynamic points that are on static surfaces; empty without any.
  Image<std::uint8_t> overruled;
  double overruled_share = 0.0;  ///< of the valid points
  /// Of the valid points, masked or not, on static surfaces; NaN where only masked ones were
  /// compared.
  double supported_share = 0.0;
  double masked_agreement = 0.0;  ///< of the masked points in known space, on static surfaces
};

/// Compares masked points of depth images with the static surfaces of recent views (beyond the
/// paper). A mask is evidence, not truth: where a surface is as it was before, its points do the
/// pose no harm, whatever the network says. People differ from it: a view measured free space where
/// they are, or had them under a mask too.
class MaskCheck {
 public:
  MaskCheck(const MaskCheckConfig& config, const DepthNoise& noise)
      : config_(config), noise_(noise), views_(config.memory, config.interval) {}

  bool enabled() const { return config_.enabled; }

  /// Whether there is a view to compare with.
  bool has_views() const { return !views_.empty(); }

  /// The points that are compared.
  enum class Points {
    kMasked,  ///< the masked ones; `MaskEvidence::supported_share` is not known then
    kAll,
  };

  /// @param cloud  organized
  MaskEvidence compare(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor,
                       Points points = Points::kAll) const;

  /// Non-zero at the dynamic points that may stand still: no free space was observed there, nor at
  /// most of the points around.
  Image<std::uint8_t> uncontradicted(const LabeledCloud& cloud,
                                     const Transform<World, Sensor>& T_world_sensor) const;

  /// Adds a view with its estimated pose; a view too soon after the last one is ignored. Its
  /// overruled points count as static.
  void remember(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);

 private:
  /// Space and surfaces that one view observed.
  struct View {
    View(const LabeledCloud& cloud, double margin, const DepthNoise& noise);

    FreeSpace all;      ///< with the surfaces of all points
    FreeSpace statics;  ///< with those of the static points
  };

  MaskCheckConfig config_;
  DepthNoise noise_;
  FreeSpaceHistory<View> views_;
  PlaceViews places_;
};

/// The cloud's labels with its overruled points static.
std::vector<PointLabel> labels_for_pose(const LabeledCloud& cloud);

}  // namespace mms
