#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "mms/core/config.hpp"
#include "mms/simulation/sensors/mask_errors.hpp"

namespace mms {

enum class Layout : std::uint8_t {
  kHall,      ///< racks in the center, a lane all round them
  kCorridor,  ///< bare walls, few features
  kAisle,     ///< a long aisle between two equal racks
};

enum class CameraTrajectory : std::uint8_t {
  kStill,   ///< stands and looks down a lane
  kLoop,    ///< once round the racks, back to where it began
  kAlong,   ///< to the end of the lane, corridor or aisle and on
  kShaken,  ///< quick turns to left and right on the way
};

/// A scene: what is built, who moves in it, how the sensor rides through. All of it follows from
/// these values and the seed.
struct SceneConfig {
  std::string name = "warehouse_loop";
  int seed = 1;
  double duration = 64.0;  ///< how long the trajectory lasts and everybody has ways for [s]
  int frames = 0;          ///< how many of its frames are played; 0: all
  double hz = 0.0;         ///< frames a second; 0: the sensor's own
  int sensor = 0;          ///< index into sensor_names()
  int width = 0;           ///< image width [px], height in proportion; 0: the sensor's own
  bool noise = true;       ///< of the sensors
  double exposure = 0.0;   ///< [s]; 0: the camera's own
  int blur_samples = 1;    ///< instants that an exposure is made of; 1: no motion blur
  Layout layout = Layout::kHall;
  CameraTrajectory trajectory = CameraTrajectory::kLoop;
  double speed = 1.0;            ///< of the sensor [m/s]
  double camera_height = 1.0;    ///< [m]
  double clutter = 1.0;          ///< density of pallets, boxes and signs, in [0, 1]
  int crossing = 6;              ///< persons who walk to and fro across the sensor's way
  double crossing_from = 2.2;    ///< nearest of their places ahead of the sensor's start [m]
  double crossing_beyond = 3.0;  ///< farthest of their places ahead of its end [m]
  int leading = 1;               ///< persons who walk ahead of the sensor
  int oncoming = 2;              ///< persons who come towards it
  int working = 2;               ///< persons who work at a rack
  int agvs = 4;                  ///< vehicles, of the five kinds in turn
  double pause_share = 0.2;      ///< share of time that walkers and vehicles stand
  double pause = 3.0;            ///< mean length of a pause [s]
  MaskErrorConfig mask_errors;

  void visit(ConfigVisitor& v);
};

/// Names of the built-in scenes, the first being the default.
std::span<const std::string_view> scene_names();

/// @throws DataError naming the known ones for another name.
SceneConfig scene_config(std::string_view name);

}  // namespace mms
