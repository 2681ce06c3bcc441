#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "mms/core/config_visitor.hpp"
#include "mms/simulation/sensors/mask_errors.hpp"
#include "mms/simulation/sensors/motion_sensors.hpp"

namespace mms {

enum class Layout : std::uint8_t {
  kHall,      ///< racks in the center, surrounded by a lane
  kCorridor,  ///< bare walls, few features
  kAisle,     ///< a long aisle between two identical racks
  kAisles,    ///< four aisles that look alike; two of them mirrored and turned
};

enum class CameraTrajectory : std::uint8_t {
  kStill,   ///< static, facing along a lane
  kLoop,    ///< once around the racks, back to the start
  kAlong,   ///< to the end of the lane, corridor or aisle, and further
  kShaken,  ///< with quick rotations to the left and right
};

/// A scene: building, actors and trajectory of the sensor. Determined by these values and the seed.
struct SceneConfig {
  std::string name = "warehouse_loop";
  int seed = 1;
  int day = 0;  ///< other days have other people and goods in the same building, in one world frame
  double duration = 64.0;  ///< length of all trajectories [s]
  int frames = 0;          ///< number of played frames; 0: all
  double hz = 0.0;         ///< frame rate [Hz]; 0: that of the sensor
  int sensor = 0;          ///< index into sensor_names()
  int width = 0;           ///< image width [px], with proportional height; 0: that of the sensor
  bool noise = true;       ///< of the sensors
  double exposure = 0.0;   ///< [s]; 0: that of the camera
  int blur_samples = 1;    ///< renderings per exposure; 1: no motion blur
  Layout layout = Layout::kHall;
  CameraTrajectory trajectory = CameraTrajectory::kLoop;
  double speed = 1.0;            ///< of the sensor [m/s]
  double camera_height = 1.0;    ///< [m]
  double clutter = 1.0;          ///< density of pallets, boxes and signs, in [0, 1]
  int crossing = 6;              ///< persons who cross the sensor's path repeatedly
  double crossing_from = 2.2;    ///< nearest of their positions, ahead of the sensor's start [m]
  double crossing_beyond = 3.0;  ///< farthest of their positions, beyond its end [m]
  int leading = 1;               ///< persons who walk ahead of the sensor
  int oncoming = 2;              ///< persons who walk towards it
  int working = 2;               ///< persons who work at a rack
  int agvs = 4;                  ///< vehicles, alternating between the five kinds
  double pause_share = 0.2;      ///< share of time that walkers and vehicles pause
  double pause = 3.0;            ///< mean length of a pause [s]
  MaskErrorConfig mask_errors;
  double turn_rate = 0.0;  ///< largest of the trajectory `shaken` [degrees/s]; 0: 76
  double dark_from = 0.0;  ///< of a time without light and depth [s]
  double dark_for = 0.0;   ///< its length [s]
  double light_for = 0.0;  ///< from its end until it is dark again [s]; 0: forever
  bool carried = false;    ///< whether the sensor is carried to an earlier place in the dark
  int companions = 0;      ///< persons who walk close ahead of the sensor, once it was carried
  double start = 0.0;      ///< of the sensor, along the lane [m]
  WheelConfig wheels;
  ImuConfig imu;

  void visit(ConfigVisitor& v);
};

/// Seed of what differs from day to day.
/// @param purpose  of the random numbers
std::uint64_t daily_seed(const SceneConfig& config, std::uint64_t purpose);

/// Names of the built-in scenes; the first is the default.
std::span<const std::string_view> scene_names();

/// @throws DataError with the known names for an unknown one.
SceneConfig scene_config(std::string_view name);

}  // namespace mms
