#include "mms/simulation/config/scene_config.hpp"

#include <algorithm>
#include <array>

#include "mms/core/error.hpp"
#include "mms/core/hash_noise.hpp"
#include "mms/simulation/sensors/sensor_preset.hpp"

namespace mms {
namespace {

constexpr std::array<std::string_view, 4> kLayouts = {"hall", "corridor", "aisle", "aisles"};
constexpr std::array<std::string_view, 4> kTrajectories = {"still", "loop", "along", "shaken"};
constexpr std::array<std::string_view, 11> kScenes = {
    "warehouse_loop", "still_walker", "crowd",      "stop_and_go", "corridor", "static",
    "fast",           "rack_aisle",   "second_day", "long_aisles", "kidnap"};

SceneConfig nobody(SceneConfig config) {
  config.crossing = config.leading = config.oncoming = config.working = config.agvs = 0;
  return config;
}

SceneConfig warehouse_loop() {
  SceneConfig config;
  config.hz = 15.0;
  return config;
}

SceneConfig still_walker() {
  SceneConfig config = nobody(warehouse_loop());
  config.duration = 20.0;
  config.trajectory = CameraTrajectory::kStill;
  config.crossing = 1;
  config.pause_share = 0.0;
  return config;
}

SceneConfig crowd() {
  SceneConfig config = nobody(warehouse_loop());
  config.duration = 20.0;
  config.trajectory = CameraTrajectory::kAlong;
  config.speed = 0.03;
  config.crossing_from = 1.25;
  config.crossing_beyond = 4.5;
  config.crossing = 9;
  config.oncoming = 4;
  config.leading = 0;
  config.agvs = 2;
  return config;
}

SceneConfig stop_and_go() {
  SceneConfig config = warehouse_loop();
  config.duration = 40.0;
  config.trajectory = CameraTrajectory::kAlong;
  config.speed = 0.4;
  config.crossing = 4;
  config.leading = 0;
  config.agvs = 5;
  config.pause_share = 0.5;
  config.pause = 10.0;
  return config;
}

SceneConfig corridor() {
  SceneConfig config = nobody(warehouse_loop());
  config.duration = 30.0;
  config.layout = Layout::kCorridor;
  config.trajectory = CameraTrajectory::kAlong;
  config.speed = 0.8;
  config.leading = 1;
  return config;
}

SceneConfig empty_hall() {
  SceneConfig config = nobody(warehouse_loop());
  config.duration = 30.0;
  return config;
}

SceneConfig fast() {
  SceneConfig config = warehouse_loop();
  config.duration = 15.0;
  config.hz = 30.0;
  config.trajectory = CameraTrajectory::kShaken;
  config.speed = 1.2;
  config.exposure = 0.016;
  config.blur_samples = 4;
  config.crossing = 3;
  config.agvs = 2;
  return config;
}

SceneConfig rack_aisle() {
  SceneConfig config = nobody(warehouse_loop());
  config.duration = 30.0;
  config.layout = Layout::kAisle;
  config.trajectory = CameraTrajectory::kAlong;
  config.speed = 0.9;
  config.leading = 1;
  config.working = 1;
  return config;
}

SceneConfig second_day() {
  SceneConfig config = warehouse_loop();
  config.day = 1;
  return config;
}

SceneConfig long_aisles() {
  SceneConfig config = warehouse_loop();
  config.duration = 285.0;
  config.hz = 10.0;
  config.layout = Layout::kAisles;
  config.speed = 1.2;
  config.crossing = 24;
  config.oncoming = 6;
  config.working = 8;
  config.agvs = 12;
  return config;
}

SceneConfig kidnap() {
  SceneConfig config = warehouse_loop();
  config.duration = 92.0;
  config.dark_from = 62.0;
  config.dark_for = 2.0;
  config.light_for = 4.0;
  config.carried = true;
  config.companions = 3;
  return config;
}

constexpr std::array<SceneConfig (*)(), kScenes.size()> kMakers = {
    warehouse_loop, still_walker, crowd,      stop_and_go, corridor, empty_hall,
    fast,           rack_aisle,   second_day, long_aisles, kidnap};

}  // namespace

void SceneConfig::visit(ConfigVisitor& v) {
  v.integer({"seed", "", "of building, stock, people, their paths and the noise"}, seed,
            {0.0, 1e9});
  v.integer({"day", "",
             "other days have other people and goods in the same building, and start elsewhere"},
            day, {0.0, 1e6});
  v.number({"duration", "s", "duration of the recording"}, duration, {0.1, 1e5});
  v.integer({"frames", "", "number of played frames; 0: all"}, frames, {0.0, 1e6});
  v.number({"hz", "1/s", "frame rate; 0: that of the sensor"}, hz, {0.0, 1000.0});
  v.choice({"sensor", "", "sensor preset"}, sensor, sensor_names());
  v.integer({"width", "px", "image width, with proportional height; 0: that of the sensor"}, width,
            {0.0, 4096.0});
  v.boolean({"noise", "", "whether the sensors are noisy"}, noise);
  v.number({"exposure", "s", "of the camera; 0: that of the preset"}, exposure, {0.0, 0.1});
  v.integer({"blur_samples", "", "renderings per exposure; 1: no motion blur"}, blur_samples,
            {1.0, 64.0});
  v.enumeration({"layout", "", "building"}, layout, kLayouts);
  v.enumeration({"trajectory", "", "trajectory of the sensor", "ride"}, trajectory, kTrajectories);
  v.number({"speed", "m/s", "of the sensor"}, speed, {0.01, 5.0});
  v.number({"camera_height", "m", "above the floor"}, camera_height, {0.2, 2.5});
  v.number({"clutter", "", "density of pallets and signs"}, clutter, {0.0, 1.0});
  v.integer({"crossing", "", "persons who cross the sensor's path repeatedly"}, crossing,
            {0.0, 40.0});
  v.number({"crossing_from", "m", "nearest of their positions, ahead of the sensor's start"},
           crossing_from, {0.5, 50.0});
  v.number({"crossing_beyond", "m", "farthest of their positions, beyond the sensor's end"},
           crossing_beyond, {0.0, 50.0});
  v.integer({"leading", "", "persons who walk ahead of the sensor"}, leading, {0.0, 8.0});
  v.integer({"oncoming", "", "persons who walk towards it"}, oncoming, {0.0, 20.0});
  v.integer({"working", "", "persons who work at a rack"}, working, {0.0, 8.0});
  v.integer({"agvs", "", "vehicles, alternating between the five kinds"}, agvs, {0.0, 20.0});
  v.number({"pause_share", "", "share of time that walkers and vehicles pause"}, pause_share,
           {0.0, 0.9});
  v.number({"pause", "s", "mean length of a pause"}, pause, {0.5, 60.0});
  v.group({"mask_errors", "", "errors of the masks"}, mask_errors);
  v.number({"turn_rate", "deg/s", "largest of the trajectory shaken; 0: 76"}, turn_rate,
           {0.0, 720.0});
  v.number({"dark_from", "s", "start of a time without light and depth"}, dark_from, {0.0, 1e5});
  v.number({"dark_for", "s", "its length"}, dark_for, {0.0, 1e5});
  v.number({"light_for", "s", "time from its end until it is dark again; 0: forever"}, light_for,
           {0.0, 1e5});
  v.boolean({"carried", "", "whether the sensor is carried to an earlier place in the dark"},
            carried);
  v.integer({"companions", "", "persons who walk close ahead of the sensor, once it was carried"},
            companions, {0.0, 8.0});
  v.number({"start", "m", "place of the sensor along the lane at the start"}, start, {0.0, 1e4});
  v.group({"wheels", "", "wheel odometry"}, wheels);
  v.group({"imu", "", "gyroscope and accelerometer"}, imu);
}

std::uint64_t daily_seed(const SceneConfig& config, std::uint64_t purpose) {
  const std::uint64_t seed = hash_of(static_cast<std::uint64_t>(config.seed), purpose);
  return config.day == 0 ? seed : hash_of(seed, static_cast<std::uint64_t>(config.day));
}

std::span<const std::string_view> scene_names() {
  return kScenes;
}

SceneConfig scene_config(std::string_view name) {
  const auto found = std::find(kScenes.begin(), kScenes.end(), name);
  if (found != kScenes.end()) {
    SceneConfig config = kMakers[static_cast<std::size_t>(found - kScenes.begin())]();
    config.name = name;
    return config;
  }
  std::string known;
  for (const std::string_view scene : kScenes)
    known += (known.empty() ? "" : ", ") + std::string(scene);
  throw DataError(std::string(name), "no such scene", "scenes: " + known);
}

}  // namespace mms
