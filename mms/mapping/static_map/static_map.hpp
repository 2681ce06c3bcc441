#pragma once

#include <cstddef>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/geometry/voxels/map_changes.hpp"
#include "mms/mapping/free_space/free_space.hpp"
#include "mms/mapping/free_space/free_space_history.hpp"
#include "mms/mapping/free_space/scan_sight.hpp"
#include "mms/mapping/static_map/frame_viewpoints.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"
#include "mms/mapping/static_map/surface_points.hpp"
#include "mms/mapping/static_map/surface_voxels.hpp"

namespace mms {

struct StaticMapConfig {
  double voxel_size = 0.02;  ///< [m]
  double scan_voxel_share = 0.005;
  double memory = 200.0;  ///< [MB]
  int min_observations = 2;
  SurfaceConfig surface{};
  CarvingConfig carving{};

  void visit(ConfigVisitor& v) {
    v.number({"voxel_size", "m", "side of a voxel, doubled whenever the memory is used up"},
             voxel_size, {0.001, 10.0});
    v.number({"scan_voxel_share", "",
              "least side of a voxel of a LiDAR's map, over the median range of the first scan",
              "scan_voxel"},
             scan_voxel_share, {0.0, 0.1});
    v.number({"memory", "MB", "budget of the map"}, memory, {1.0, 1e6});
    v.integer({"min_observations", "",
               "views, from keyframe to keyframe, that must measure a voxel before it is shown"},
              min_observations, {1.0, 1000.0});
    v.group({"surface", "", "selection of the points that enter the map"}, surface);
    v.group({"carving", "", "removal of voxels in observed free space"}, carving);
  }
};

/// Changes of the static map by one keyframe.
struct MapUpdate {
  std::size_t points = 0;  ///< added
  std::size_t carved = 0;  ///< voxels removed because they are seen through
  bool coarsened = false;  ///< the voxel size grew to keep to the memory budget
};

/// The dense coloured static map (III-D): static points, down-sampled by a voxel grid to running
/// means of position, colour and normal. A keyframe and the frames since the one before it are one
/// view: all their measurements of a voxel are one observation.
///
/// Beyond the paper: frames between keyframes add to the map, since the holes of depth images vary.
/// Points that a mask missed leave ghosts of people in the map; a voxel is removed once keyframes
/// that measure a surface behind it outnumber those that measured it (`FreeSpace` of images,
/// `ScanSight` of LiDAR scans). The memory is bounded: when the budget is used up, voxels are
/// merged to twice their size, so that the map stays complete. The voxels of a LiDAR's map follow
/// the range of its first scan, since the distances between points do. A scan's points where recent
/// scans saw through are left out: an object has come there, and may leave without being seen.
class StaticMap {
 public:
  explicit StaticMap(const StaticMapConfig& config = {});

  /// Adds a keyframe's static points and removes the voxels that it sees through. A pose that is
  /// not finite changes nothing.
  /// @throws DataError when an organised cloud's `camera` makes no camera.
  MapUpdate integrate(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);

  /// Adds the static points of a frame between two keyframes, to the next one's view. A pose that
  /// is not finite changes nothing.
  /// @return  points added
  std::size_t add(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);

  /// Ends the view of the frames since the last keyframe at the end of a run, so that `changes`
  /// contains them. @return  false where there are none
  bool finalize();

  /// The voxels that `is_voxel_shown` for `min_observations` views (or for all, while there are
  /// fewer), in the order in which they came into the map.
  MapCloud cloud() const;

  /// The same with a normal for every point, as needed for a LiDAR's (`fill_sparse_normals`). It
  /// takes about a second for 500,000 points.
  MapCloud cloud_with_normals() const;

  /// Stamps of the last frames that measured the points of `cloud`. Not for a map made by `apply`.
  std::vector<Timestamp> stamps() const;

  /// Changes by the last view: `apply` of all views' changes, in order, makes a map that shows the
  /// same voxels; their means and counts are those of when the count last doubled.
  MapChanges changes() const;

  /// Applies the changes by a view of another map with the same settings. Such a map serves `cloud`
  /// alone: it has no weights, so keyframes cannot be integrated into it.
  /// @throws DataError when a voxel's number exceeds its block.
  void apply(const MapChanges& changes);

  std::size_t size() const { return grid_.size(); }  ///< voxels, those with few observations too
  std::size_t memory_bytes() const { return grid_.memory_bytes(); }
  double voxel_size() const { return grid_.voxel_size(); }  ///< current one [m]
  std::size_t views() const { return views_; }              ///< completed

 private:
  void choose_voxel_size(const LabeledCloud& first_scan);
  /// Removes the points of a scan that several recent scans saw through.
  void leave_out_arrivals(Timestamp stamp, const Transform<World, Sensor>& T_world_sensor,
                          std::vector<SurfacePoint>& points) const;
  /// @param max_hits  of a voxel that count when it is carved
  void insert(const std::vector<SurfacePoint>& points, const Eigen::Isometry3f& T_world_sensor,
              std::uint16_t max_hits);
  std::size_t carve(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);
  template <class Space>
  std::size_t carve(const Space& free_space, double views_per_hit, std::uint16_t max_hits,
                    const Eigen::Isometry3f& T_sensor_world);
  void count_view();
  bool keep_to_budget();
  void prune_viewpoints();
  std::uint32_t last_frame() const { return viewpoints_.last(); }
  Eigen::Vector3f normal_of(const VoxelBlock& block, const Voxel& voxel) const;
  template <class Visit>
  void for_each_shown(const Visit& visit) const;

  StaticMapConfig config_;
  VoxelGrid grid_;
  FrameViewpoints viewpoints_;
  FreeSpaceHistory<ScanSight> recent_;  // of scans
  std::size_t views_ = 0;
  std::uint32_t last_view_ = 0;             // the frame that ended it
  std::uint32_t previous_view_ = 0;         // the frame that ended the one before
  std::vector<std::uint32_t> measured_;     // blocks, since the last view
  std::vector<std::uint32_t> view_blocks_;  // blocks that the last view measured, ascending
  std::vector<VoxelKey> carved_;            // by the last view
  bool is_scan_ = false;                    // the last cloud
  bool is_resized_ = false;                 // since the last view
  bool coarsened_ = false;                  // by the last view
};

}  // namespace mms
