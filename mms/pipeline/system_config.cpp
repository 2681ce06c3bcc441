#include "mms/pipeline/system_config.hpp"

namespace mms {

void SystemConfig::visit(ConfigVisitor& v) {
  v.group({"depth_noise", "", "the depth camera's noise, used by every module"}, noise.depth);
  v.boolean({"measure_depth_noise", "",
             "raise depth_noise to that of a run's first depth image, if that is larger"},
            measure_depth_noise);
  v.number({"lidar_noise", "m", "one sigma of LiDAR range, used by every module"}, noise.range,
           {1e-4, 0.5});
  v.group({"segmentation", "", "people and vehicles in the picture (III-A)"}, segmentation);
  v.group({"fusion", "", "masks and geometry into static and dynamic points (III-B)"}, fusion);
  v.group({"features", "", "edge and planar features (III-C.1)"}, features);
  v.group({"odometry", "", "data association and pose (III-C.2, III-C.3)"}, odometry);
  v.group({"robot_body", "", "parts of the robot in the view of the depth camera"}, robot_body);
  v.group({"motion_segmentation", "", "moving objects without a mask", "movement"},
          motion_segmentation);
  v.group({"mask_check", "", "masks that recent views contradict"}, mask_check);
  v.group({"keyframes", "", "which frames update the static map (III-C.4)"}, keyframes);
  v.group({"static_map", "", "dense colored map of static surfaces (III-D)"}, static_map);
  v.group({"occupancy", "", "free and occupied space, for robots"}, occupancy);
  v.group({"dynamic_map", "", "tracked objects (III-D)"}, dynamic_map);
  v.group({"global_map", "", "loop closure"}, global_map);
}

}  // namespace mms
