#include "mms/map_file/session_changes.hpp"

#include <tsl/robin_map.h>

#include <algorithm>
#include <cmath>

#include "mms/geometry/voxels/voxel_key.hpp"
#include "mms/map_file/map_composition.hpp"
#include "mms/mapping/free_space/free_space.hpp"
#include "mms/mapping/free_space/scan_free_space.hpp"

namespace mms {
namespace {

/// [m]: distance before a surface, above noise, that counts as seen through. The views have few
/// pixels, as those that check loops.
constexpr double kMargin = 0.1;

/// [m]: the same of scans, noise included: as where these check loops.
constexpr double kScanMargin = 0.2;

/// [m]: distance from a LiDAR up to which its keyframes are compared. Source: initial choice; its
/// directions are a degree wide, 35 cm there.
constexpr float kScanRange = 20.0F;

/// [s]: stamps above are dates, those below times since a start. Source: 2001.
constexpr double kFirstDate = 1e9;

/// [-]: keyframes that must see through a point.
constexpr int kMinViews = 2;

/// [m]: side of the cubes of points that are compared with a view together.
constexpr double kCubeSide = 1.0;

/// What the keyframes of one session saw at a point.
struct Evidence {
  int through = 0;
  int surface = 0;

  bool is_through() const { return through >= kMinViews && surface == 0; }
};

/// What the other sessions say about a point of one session.
class PointHistory {
 public:
  /// Adds the sessions one after the other.
  void add(const Evidence& seen, bool is_later) {
    is_known_ = is_known_ || seen.surface > 0;
    is_new_ = is_new_ || (!is_later && seen.is_through());
    if (is_later && (seen.surface > 0 || seen.is_through())) is_gone_ = seen.is_through();
  }

  Change change() const {
    if (is_gone_) return Change::kGone;
    if (is_new_) return Change::kNew;
    return is_known_ ? Change::kUnchanged : Change::kUnknown;
  }

 private:
  bool is_known_ = false;
  bool is_new_ = false;
  bool is_gone_ = false;  ///< by the last session that looked there
};

bool may_see_into(const FreeSpace& space, const Eigen::Vector3f& center, float radius) {
  return space.may_see_into(center, radius);
}

bool may_see_into(const ScanFreeSpace& /*space*/, const Eigen::Vector3f& center, float radius) {
  return center.norm() < kScanRange + radius;
}

/// Points in cubes, so that most are not compared with a view that cannot see them.
class PointCubes {
 public:
  explicit PointCubes(const std::vector<Eigen::Vector3f>& points) : points_(points) {
    tsl::robin_map<VoxelKey, std::size_t, VoxelKeyHash> index;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const VoxelKey key = voxel_key(points[i], static_cast<float>(1.0 / kCubeSide));
      const auto [known, is_new] = index.try_emplace(key, cubes_.size());
      if (is_new) cubes_.push_back({key, {}});
      cubes_[known->second].points.push_back(i);
    }
  }

  /// @param statics  the space by static returns alone: people are no surfaces of a map
  template <class Space>
  void compare(const Space& space, const Space& statics, const Eigen::Isometry3f& T_view_map,
               std::vector<Evidence>& evidence) const {
    constexpr auto kSide = static_cast<float>(kCubeSide);
    for (const Cube& cube : cubes_) {
      const Eigen::Vector3f corner(static_cast<float>(cube.key.x), static_cast<float>(cube.key.y),
                                   static_cast<float>(cube.key.z));
      const Eigen::Vector3f center = (corner.array() + 0.5F).matrix() * kSide;
      // Surfaces have to be seen, too: they lie up to the margin behind what is seen through.
      const float radius = kHalfDiagonal * kSide + 3.0F * static_cast<float>(kMargin);
      if (!may_see_into(space, T_view_map * center, radius)) continue;
      for (const std::uint32_t i : cube.points) {
        const Eigen::Vector3f point = T_view_map * points_[i];
        const SpaceState state = space.state_at(point);
        evidence[i].through += state == SpaceState::kFree;
        evidence[i].surface +=
            state == SpaceState::kSurface && statics.state_at(point) == SpaceState::kSurface;
      }
    }
  }

 private:
  struct Cube {
    VoxelKey key;
    std::vector<std::uint32_t> points;
  };

  const std::vector<Eigen::Vector3f>& points_;
  std::vector<Cube> cubes_;
};

LabeledCloud statics_of(LabeledCloud cloud) {
  for (PointLabel& label : cloud.labels) {
    if (label == PointLabel::kDynamic) label = PointLabel::kInvalid;
  }
  return cloud;
}

/// Compares points of the map with the keyframes of a session.
std::vector<Evidence> evidence_of(std::uint32_t session, const GlobalMapContent& content,
                                  const PointCubes& cubes, std::size_t points,
                                  const DepthNoise& noise) {
  std::vector<Evidence> evidence(points);
  for (std::size_t i = 0; i < content.records.size(); ++i) {
    const KeyframeRecord& record = content.records[i];
    if (record.session != session || record.is_pose_only()) continue;
    const Eigen::Isometry3f T_view_map = content.poses[i].inverse().cast<float>();
    if (record.is_scan()) {
      const LabeledCloud cloud = record.scan.cloud();
      cubes.compare(ScanFreeSpace(cloud, kScanMargin),
                    ScanFreeSpace(statics_of(cloud), kScanMargin), T_view_map, evidence);
    } else {
      const LabeledCloud cloud = record.view.cloud();
      cubes.compare(FreeSpace(cloud, kMargin, noise), FreeSpace(statics_of(cloud), kMargin, noise),
                    T_view_map, evidence);
    }
  }
  return evidence;
}

/// Sessions in the order of time; in that of the file where their stamps have no common zero.
std::vector<std::uint32_t> in_time(std::vector<std::uint32_t> sessions, const MapFile& file) {
  const auto begin = [&](std::uint32_t session) { return file.sessions()[session].begin; };
  const bool has_dates = std::all_of(sessions.begin(), sessions.end(), [&](std::uint32_t session) {
    return begin(session).seconds() > kFirstDate;
  });
  if (has_dates) {
    std::stable_sort(sessions.begin(), sessions.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return begin(a) < begin(b); });
  }
  return sessions;
}

}  // namespace

MapCloud points_of(const MapChangeCloud& cloud, std::initializer_list<Change> changes) {
  MapCloud chosen;
  for (std::size_t i = 0; i < cloud.changes.size(); ++i) {
    if (std::find(changes.begin(), changes.end(), cloud.changes[i]) == changes.end()) continue;
    chosen.points.push_back(cloud.map.points[i]);
    chosen.colors.push_back(cloud.map.colors[i]);
    chosen.normals.push_back(cloud.map.normals[i]);
    chosen.observations.push_back(cloud.map.observations[i]);
  }
  return merged(chosen, cloud.voxel_size);
}

MapChangeCloud find_changes(const MapFile& file, const GlobalMapContent& content,
                            const DepthNoise& noise, const MapFile::WarningHandler& warn) {
  MapChangeCloud result;
  const std::vector<std::uint32_t> sessions = in_time(joined_sessions(content), file);
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const std::uint32_t session = sessions[i];
    const StampedMap surfaces = corrected_surfaces(file, content, session, warn);
    const PointCubes cubes(surfaces.cloud.points);
    std::vector<PointHistory> histories(surfaces.cloud.size());
    for (std::size_t k = 0; k < sessions.size(); ++k) {
      if (k == i) continue;
      const std::vector<Evidence> evidence =
          evidence_of(sessions[k], content, cubes, histories.size(), noise);
      for (std::size_t p = 0; p < histories.size(); ++p) histories[p].add(evidence[p], k > i);
    }
    for (const PointHistory& history : histories) result.changes.push_back(history.change());
    append(result.map, surfaces.cloud);
    result.voxel_size = std::max(result.voxel_size, file.sessions()[session].voxel_size);
  }
  return result;
}

}  // namespace mms
