#pragma once

#include "mms/simulation/config/scene_config.hpp"
#include "mms/simulation/world/motion.hpp"

namespace mms {

/// Whether it is dark at a time [s].
bool is_dark(const SceneConfig& config, double seconds);

/// Position relative to the sensor's robot.
struct Companion {
  double ahead = 0.0;  ///< on its path [s]
  double aside = 0.0;  ///< to the left of its path [m]
};

/// The trajectory of the robot, carried in each dark time to near an earlier place of it.
/// @param way      the trajectory if it were not carried
/// @param seconds  duration
Motion carried(const SceneConfig& config, const Motion& way, double seconds);

/// A person who walks with the robot. Before it is first carried, half that time ahead of it.
Motion accompany(const SceneConfig& config, const Motion& way, double seconds,
                 const Companion& companion);

}  // namespace mms
