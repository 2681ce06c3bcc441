#include "mms/simulation/world/stage.hpp"

#include <utility>

namespace mms {
namespace {

std::vector<const Mesh*> parts_of(const std::vector<Actor>& actors) {
  std::vector<const Mesh*> parts;
  for (const Actor& actor : actors) {
    for (const Mesh& part : actor.model->parts()) parts.push_back(&part);
  }
  return parts;
}

}  // namespace

Stage::Stage(Building building, std::vector<Actor> actors)
    : building_(std::move(building)),
      actors_(std::move(actors)),
      parts_(parts_of(actors_)),
      rays_(building_.mesh, parts_),
      surfaces_(building_.mesh, parts_) {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    first_part_.push_back(object_of_part_.size());
    object_of_part_.resize(object_of_part_.size() + actors_[i].model->parts().size(),
                           static_cast<std::uint8_t>(i + 1));
  }
  first_part_.push_back(object_of_part_.size());
  set(0.0);
}

void Stage::set(double seconds) {
  std::vector<Eigen::Isometry3d> poses;
  std::vector<Activity> activities;
  for (const Actor& actor : actors_) {
    poses.push_back(actor.motion.T_world_object(seconds));
    activities.push_back(actor.activity(seconds));
  }
  set(std::move(poses), activities);
}

void Stage::set(std::vector<Eigen::Isometry3d> T_building_object,
                const std::vector<Activity>& activities) {
  T_building_object_ = std::move(T_building_object);
  T_building_part_.clear();
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    const Eigen::Isometry3f T = T_building_object_[i].cast<float>();
    for (const auto& T_object_part : actors_[i].model->pose(activities[i])) {
      T_building_part_.push_back(T * T_object_part);
    }
  }
  rays_.place(T_building_part_);
  surfaces_.place(T_building_part_);
}

void Stage::look(const RayTable& table, const Eigen::Isometry3d& T_building_camera,
                 const RenderTarget& target) const {
  render(rays_, surfaces_, building_.lights, object_of_part_, table,
         T_building_camera.cast<float>(), target);
}

std::uint8_t Stage::object_of(const RayHit& hit) const {
  return hit.part <= 0 ? std::uint8_t{0} : object_of_part_[static_cast<std::size_t>(hit.part - 1)];
}

}  // namespace mms
