#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/simulation/building/building.hpp"
#include "mms/simulation/sensors/renderer.hpp"
#include "mms/simulation/world/actors.hpp"

namespace mms {

/// A building with actors, ready for rendering, in the building's frame. Not thread-safe: it is set
/// to one instant and then rendered.
class Stage {
 public:
  Stage(Building building, std::vector<Actor> actors);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  const Building& building() const { return building_; }
  const std::vector<Actor>& actors() const { return actors_; }

  /// Sets all actors to time `seconds` [s].
  void set(double seconds);

  /// Sets actor i to `T_building_object[i]` with `activities[i]`.
  void set(std::vector<Eigen::Isometry3d> T_building_object,
           const std::vector<Activity>& activities);

  /// Renders the view of a camera.
  void look(const RayTable& table, const Eigen::Isometry3d& T_building_camera,
            const RenderTarget& target) const;

  /// Geometry for ray casting; 0 static, else 1 + id of a hit's object.
  const RayScene& rays() const { return rays_; }
  SurfacePoint surface(const Ray& ray, const RayHit& hit) const { return surfaces_.at(ray, hit); }
  std::uint8_t object_of(const RayHit& hit) const;

  /// An actor's parts as [first, last) of the ray scene's, their shapes and poses.
  std::size_t first_part(std::size_t actor) const { return first_part_[actor]; }
  std::size_t last_part(std::size_t actor) const { return first_part_[actor + 1]; }
  const Mesh& part(std::size_t index) const { return *parts_[index]; }
  const Eigen::Isometry3f& T_building_part(std::size_t index) const {
    return T_building_part_[index];
  }
  const Eigen::Isometry3d& T_building_object(std::size_t actor) const {
    return T_building_object_[actor];
  }

 private:
  Building building_;
  std::vector<Actor> actors_;
  std::vector<const Mesh*> parts_;
  std::vector<std::size_t> first_part_;  ///< of each actor, and one beyond the last
  std::vector<std::uint8_t> object_of_part_;
  std::vector<Eigen::Isometry3d> T_building_object_;
  std::vector<Eigen::Isometry3f> T_building_part_;
  RayScene rays_;
  SurfaceLookup surfaces_;
};

}  // namespace mms
