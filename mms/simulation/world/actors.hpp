#pragma once

#include <memory>
#include <vector>

#include "mms/simulation/building/building.hpp"
#include "mms/simulation/config/scene_config.hpp"
#include "mms/simulation/models/articulated_model.hpp"
#include "mms/simulation/world/camera_trajectory.hpp"
#include "mms/simulation/world/motion.hpp"

namespace mms {

/// A person or AGV with its trajectory.
struct Actor {
  std::unique_ptr<ArticulatedModel> model;
  Motion motion;

  Activity activity(double seconds) const {
    return {seconds, motion.travelled(seconds), motion.velocity(seconds).norm()};
  }
};

/// All actors of a scene, on trajectories that keep clear of the sensor's robot and of each other.
/// Actors without such a trajectory are omitted.
std::vector<Actor> cast_actors(const SceneConfig& config, const Building& building,
                               const CameraMotion& camera, double seconds);

}  // namespace mms
