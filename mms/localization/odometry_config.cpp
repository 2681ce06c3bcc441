#include "mms/localization/odometry_config.hpp"

namespace mms {

void OdometryConfig::visit(ConfigVisitor& v) {
  v.number({"voxel_size", "m",
            "edge of the local maps' voxels; 0: by the first frame, of scans by later ones, too"},
           voxel_size, {0.0, 10.0});
  v.number({"map_radius", "m", "local maps reach this far; 0 is 200 voxels"}, map_radius,
           {0.0, 1000.0});
  v.integer({"max_voxels", "", "bound on the voxels of a local map"}, max_voxels,
            {1000, 10'000'000});
  v.integer({"min_inliers", "", "a frame with fewer inlier residuals is lost"}, min_inliers,
            {6, 100000});
  v.number({"min_inlier_share", "", "a frame with a smaller share of inliers is lost"},
           min_inlier_share, {0.0, 1.0});
  v.group({"motion", "", "how the sensor moves between frames"}, motion);
  v.group({"registration", "", "robust Gauss-Newton of a frame against the local maps"},
          registration);
}

}  // namespace mms
