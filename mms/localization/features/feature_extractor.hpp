#pragma once

#include "mms/core/config_visitor.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/sensor_noise.hpp"
#include "mms/localization/features/feature_cloud.hpp"

namespace mms {

struct FeatureConfig {
  int sector_px = 8;  ///< side of the image sectors features are spread over
  int planes_per_sector = 2;
  int edges_per_sector = 1;
  double edge_smoothness = 0.005;
  double plane_smoothness = 0.006;
  double min_incidence = 0.2;
  double scan_voxel = 0.0;
  int pyramid_levels = 3;
  SensorNoise noise{};  ///< no setting of its own: `SystemConfig::noise`

  void visit(ConfigVisitor& v);
};

/// Feature extraction (III-C.1) on the static points.
///
/// The smoothness of a point is eq. (2), the mean of ‖p_k‖ - ‖p_i‖ over the neighbors within a
/// radius, divided by ‖p_k‖ so that it does not depend on range: positive on concave, negative on
/// convex edges, near zero on planes. Edges are the largest magnitudes, planes the smallest, each
/// chosen per image sector (organised) or direction sector (scan) so that they spread over the
/// view. Points at occlusion borders and on surfaces seen at grazing incidence are no features.
class FeatureExtractor {
 public:
  explicit FeatureExtractor(const FeatureConfig& config) : config_(config) {}

  FeatureCloud extract(const LabeledCloud& cloud) const;

 private:
  FeatureConfig config_;
};

}  // namespace mms
