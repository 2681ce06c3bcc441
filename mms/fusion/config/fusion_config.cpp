#include "mms/fusion/config/fusion_config.hpp"

#include <cstdint>
#include <string_view>

namespace mms {
namespace {

/// [-]: points of a cloud whose stride the settings leave open. Source: images of 848x480 with a
/// stride of 2 have 101,760; the method is tuned for 76,800, of 640x480 with a stride of 2.
constexpr std::int64_t kMaxCloudPoints = 110000;

}  // namespace

int FusionConfig::stride_of(const CameraIntrinsics& camera) const {
  if (stride > 0) return stride;
  const std::int64_t width = camera.width;  // a calibration may claim any size
  const std::int64_t height = camera.height;
  int automatic = 1;
  while ((width / automatic) * (height / automatic) > kMaxCloudPoints) ++automatic;
  return automatic;
}

void PlaneRemoval::visit(ConfigVisitor& v) {
  v.number({"min_area", "m^2", "smallest plane removed before clustering"}, min_area, {0.0, 1e4});
  v.number({"min_extent", "m", "least length of its shorter side"}, min_extent, {0.0, 100.0});
  v.number({"min_share", "", "its smallest share of the valid points"}, min_share, {0.0, 1.0});
  v.number({"tolerance", "m", "distance to the plane, before noise"}, tolerance, {0.0, 1.0});
  v.number({"noise_factor", "sigma", "depth noise added to it"}, noise_factor, {0.0, 10.0});
  v.number({"max_normal_angle", "rad", "between a point's and the plane's normal"},
           max_normal_angle, {0.0, 1.6});
  v.number({"max_masked_share", "", "of a plane under masks; above, it is an object's flat side"},
           max_masked_share, {0.0, 1.0});
  v.integer({"max_planes", "", "planes removed a frame; 0 removes none"}, max_planes, {0, 8});
}

void ObjectSize::visit(ConfigVisitor& v) {
  v.number({"length", "m", "largest longest side of one object"}, length, {0.0, 50.0});
  v.number({"width", "m", "largest side of the other two"}, width, {0.0, 50.0});
  v.number({"depth", "",
            "largest extent along the view of parts under one mask, over their visible side"},
           depth, {0.0, 50.0});
}

void FusionConfig::visit(ConfigVisitor& v) {
  constexpr std::string_view kModes[] = {"multimodal", "vision", "none"};
  v.enumeration({"mode", "", "what decides whether a point is dynamic"}, mode, kModes);
  v.integer(
      {"stride", "px",
       "image pixels a side that make one cloud point; 0: the least with at most 110,000 points"},
      stride, {0, 16});
  v.number({"min_range", "m", "nearest depth used"}, min_range, {0.01, 100.0});
  v.number({"max_range", "m", "farthest depth used"}, max_range, {0.1, 200.0});
  v.number({"dilation", "", "radius masks grow by, as a share of the image width"}, dilation,
           {0.0, 0.1});
  v.integer({"cluster_stride", "", "cloud points a side that share a node for clustering"},
            cluster_stride, {1, 8});
  v.number({"cluster_tolerance", "m", "gap that ends a cluster, before noise"}, cluster_tolerance,
           {0.005, 2.0});
  v.number({"fine_tolerance", "m", "gap that ends a continuous surface, before noise"},
           fine_tolerance, {0.005, 2.0});
  v.number({"noise_factor", "sigma", "depth noise added to distances between points"}, noise_factor,
           {0.0, 10.0});
  v.integer({"min_points", "", "nodes of the smallest cluster"}, min_points, {1, 100000});
  v.integer({"max_points", "", "nodes of the largest cluster"}, max_points, {1, 10000000});
  v.number({"dynamic_share", "", "least share of masked nodes that makes a cluster dynamic"},
           dynamic_share, {0.0, 1.0});
  v.number({"partial_share", "", "the same for clusters of the size of one object"}, partial_share,
           {0.0, 1.0});
  v.number({"instance_share", "", "of an instance's nodes that make a piece of a cluster dynamic"},
           instance_share, {0.0, 1.0});
  v.number({"contact_share", "", "of a smaller piece's nodes that may touch the cluster's rest"},
           contact_share, {0.0, 1.0});
  v.number(
      {"division_share", "", "part of a cluster under a mask that makes it an object of its own"},
      division_share, {0.0, 1.0});
  v.number({"division_distance", "m", "least distance across the floor of objects in one cluster"},
           division_distance, {0.0, 10.0});
  v.number({"relabel_radius", "m", "how far a dynamic cluster relabels points, before noise"},
           relabel_radius, {0.0, 2.0});
  v.boolean({"plausibility", "", "drop masks that cannot be objects in 3D"}, plausibility);
  v.number(
      {"memory", "s",
       "how long an object of depth images stays dynamic without a mask at most; 0: not at all"},
      memory, {0.0, 60.0});
  v.number({"lidar_max_range", "m", "farthest LiDAR return used"}, lidar_max_range, {1.0, 500.0});
  v.number({"lidar_voxel", "m", "voxel that thins a LiDAR scan before clustering"}, lidar_voxel,
           {0.01, 2.0});
  v.number({"lidar_tolerance", "m", "gap that ends a cluster of a LiDAR scan"}, lidar_tolerance,
           {0.01, 5.0});
  v.group({"planes", "", "planes removed before clustering"}, planes);
  v.group({"person", "", "size of a person"}, sizes[0]);
  v.group({"agv", "", "size of a vehicle"}, sizes[1]);
}

}  // namespace mms
