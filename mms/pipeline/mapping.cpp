#include "mms/pipeline/mapping.hpp"

#include <cassert>
#include <vector>

#include "mms/geometry/parallel.hpp"
#include "mms/mapping/tracking/unseen_objects.hpp"
#include "mms/pipeline/stage_timer.hpp"

namespace mms {
namespace {

StaticMapConfig static_map_config(const SystemConfig& config) {
  StaticMapConfig map = config.static_map;
  map.surface = with_noise(map.surface, config.noise);
  return map;
}

StampedMap stamped(const StaticMap& map) {
  return {map.cloud(), map.stamps(), map.voxel_size()};
}

}  // namespace

Mapping::Mapping(const SystemConfig& config)
    : config_(config),
      static_map_(static_map_config(config)),
      occupancy_map_(config.occupancy, static_map_config(config).surface),
      // The least area is meant for the whole map, not for a view.
      dynamic_map_(config.dynamic_map, {.max_tilt = config.occupancy.floor.max_tilt}) {}

FrameResult Mapping::map(FrameResult result) {
  assert(thread_.is_owner());
  if (result.session != earlier_maps_.size()) begin_session();
  if (result.begins_anew) clear_maps();
  result.objects = timed(result.stage_ms, Stage::kMapping, [&] {
    const Transform<World, Sensor>& T_world_sensor = result.odometry.T_world_sensor;
    dynamic_map_.update(result.cloud, result.odometry);  // III-D
    std::vector<TrackedObject> objects = dynamic_map_.objects();
    mask_unseen_objects(objects, T_world_sensor, result.cloud);
    if (result.keyframe) {
      parallel_tasks([&] { static_map_.integrate(result.cloud, T_world_sensor); },
                     [&] { occupancy_map_.integrate(result.cloud, T_world_sensor); });
    } else if (result.odometry.status != Status::kLost) {
      static_map_.add(result.cloud, T_world_sensor);
    }
    return objects;
  });
  return result;
}

/// What was mapped before is as it is, since the pose relative to it is not known.
void Mapping::begin_session() {
  static_map_.finalize();
  earlier_maps_.push_back(stamped(static_map_));
  clear_maps();
}

void Mapping::clear_maps() {
  static_map_ = StaticMap(static_map_config(config_));
  occupancy_map_ = OccupancyMap(config_.occupancy, static_map_config(config_).surface);
  is_cleared_ = true;
}

std::optional<MapChanges> Mapping::finalize() {
  assert(thread_.is_owner());
  if (!static_map_.finalize()) return std::nullopt;
  return changes();
}

MapChanges Mapping::changes() const {
  assert(thread_.is_owner());
  MapChanges changes = static_map_.changes();
  if (is_cleared_ && static_map_.views() == 1) changes.whole = true;
  return changes;
}

std::vector<StampedMap> Mapping::session_maps() const {
  assert(thread_.is_owner());
  std::vector<StampedMap> maps = earlier_maps_;
  maps.push_back(stamped(static_map_));
  return maps;
}

const StaticMap& Mapping::static_map() const {
  assert(thread_.is_owner());
  return static_map_;
}

const OccupancyMap& Mapping::occupancy_map() const {
  assert(thread_.is_owner());
  return occupancy_map_;
}

const DynamicMap& Mapping::dynamic_map() const {
  assert(thread_.is_owner());
  return dynamic_map_;
}

}  // namespace mms
