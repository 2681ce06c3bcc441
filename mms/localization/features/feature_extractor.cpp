#include "mms/localization/features/feature_extractor.hpp"

#include "mms/localization/features/intensity_pyramid.hpp"
#include "mms/localization/features/organised_features.hpp"
#include "mms/localization/features/scan_features.hpp"

namespace mms {

void FeatureConfig::visit(ConfigVisitor& v) {
  v.integer({"sector_px", "px",
             "side of the sectors of the cloud's grid features are spread over; half of it in "
             "small images"},
            sector_px, {4, 64});
  v.integer({"planes_per_sector", "", "planar features taken from a sector"}, planes_per_sector,
            {0, 16});
  v.integer({"edges_per_sector", "", "edge features taken from a sector"}, edges_per_sector,
            {0, 16});
  v.number({"edge_smoothness", "", "eq. (2) over range above which a point is an edge"},
           edge_smoothness, {0.0, 1.0});
  v.number({"plane_smoothness", "", "eq. (2) over range below which a point may be planar"},
           plane_smoothness, {0.0, 1.0});
  v.number({"min_incidence", "", "least |cos| between a planar feature's normal and its ray"},
           min_incidence, {0.0, 0.9});
  v.number({"scan_voxel", "m", "grid the scan is thinned to; 0 chooses it from the scan's range"},
           scan_voxel, {0.0, 5.0});
  v.integer({"pyramid_levels", "", "levels of the intensity pyramid"}, pyramid_levels, {1, 6});
}

FeatureCloud FeatureExtractor::extract(const LabeledCloud& cloud) const {
  FeatureCloud features;
  features.stamp = cloud.stamp;
  features.points_offset = cloud.points_offset;
  if (cloud.organised()) {
    extract_organised_features(cloud, config_, features);
    if (!cloud.colors.empty()) {
      features.intensity = build_intensity_pyramid(cloud, config_.pyramid_levels);
    }
  } else {
    extract_scan_features(cloud, config_, features);
  }
  return features;
}

}  // namespace mms
