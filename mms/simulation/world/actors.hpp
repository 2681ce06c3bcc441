#pragma once

#include <memory>
#include <vector>

#include "mms/simulation/building/building.hpp"
#include "mms/simulation/config/scene_config.hpp"
#include "mms/simulation/models/articulated_model.hpp"
#include "mms/simulation/world/motion.hpp"

namespace mms {

/// A person or AGV on its way.
struct Actor {
  std::unique_ptr<ArticulatedModel> model;
  Motion motion;

  Activity activity(double seconds) const {
    return {seconds, motion.travelled(seconds), motion.velocity(seconds).norm()};
  }
};

/// Everybody a scene asks for, on ways that keep clear of the sensor's robot and of each other. Who
/// finds no such way is left out.
std::vector<Actor> cast_actors(const SceneConfig& config, const Building& building,
                               const Motion& robot, double seconds);

}  // namespace mms
