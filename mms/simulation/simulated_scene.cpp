#include "mms/simulation/simulated_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/core/hash_noise.hpp"
#include "mms/simulation/truth/mesh_sampling.hpp"
#include "mms/simulation/truth/object_visibility.hpp"
#include "mms/simulation/world/camera_trajectory.hpp"
#include "mms/simulation/world/carrying.hpp"
#include "mms/simulation/world/lidar_scan.hpp"
#include "mms/simulation/world/stage.hpp"

namespace mms {
namespace {

constexpr double kMovingSpeed = 0.05;  // [m/s]
constexpr float kExposure = 0.78F;     // radiance of a white surface under good light

SensorPreset sensor_of(const SceneConfig& config) {
  SensorPreset preset = sensor_preset(sensor_names()[static_cast<std::size_t>(config.sensor)]);
  if (config.hz > 0.0) preset.hz = config.hz;
  if (config.exposure > 0.0) preset.color.exposure = config.exposure;
  if (config.width > 0) {
    CameraIntrinsics& camera = preset.color.intrinsics;
    const double scale = static_cast<double>(config.width) / camera.width;
    camera.cx = (camera.cx + 0.5) * scale - 0.5;
    camera.cy = (camera.cy + 0.5) * scale - 0.5;
    camera.fx *= scale;
    camera.fy *= scale;
    camera.width = config.width;
    camera.height = static_cast<int>(std::lround(camera.height * scale));
  }
  return preset;
}

std::shared_ptr<const Calibration> calibration_of(const SensorPreset& sensor) {
  auto calibration = std::make_shared<Calibration>();
  calibration->camera = sensor.color.intrinsics;
  calibration->T_camera_lidar = Transform<Camera, Lidar>(sensor.T_camera_lidar);
  calibration->depth_scale = sensor.depth_scale;
  return calibration;
}

/// Mounting of the gyroscope on the sensor: any known one.
Eigen::Isometry3d T_sensor_imu() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(0.02, -0.01, 0.03);
  T.linear() = (Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return T;
}

/// Exact depth within the camera's range, 0 elsewhere.
Image<float> ideal_depth(const ExactView& view, const DepthSensor& sensor) {
  Image<float> depth = view.depth;
  for (float& z : depth.pixels()) {
    if (!(z >= sensor.min_range && z <= sensor.max_range)) z = 0.0F;
  }
  return depth;
}

}  // namespace

struct SimulatedScene::Impl {
  SceneConfig config;
  SensorPreset sensor;
  double seconds;  ///< length
  Stage stage;
  CameraMotion trajectory;
  RayTable table;
  std::shared_ptr<const Calibration> calibration;
  Eigen::Isometry3d T_world_building;

  explicit Impl(const SceneConfig& scene_config)
      : config(scene_config),
        sensor(sensor_of(scene_config)),
        seconds(std::max(config.duration, config.frames / sensor.hz) + 1.0),
        stage(make_stage()),
        trajectory(config, stage.building(), seconds),
        table(ray_table(sensor.color.intrinsics)),
        calibration(calibration_of(sensor)),
        T_world_building(first_pose().inverse()) {
    if (config.carried && config.wheels.enabled) {
      throw DataError(config.name, "wheels cannot measure how the sensor is carried",
                      "carried: false, or wheels.enabled: false");
    }
    calibration = std::make_shared<const Calibration>(with_mounting(*calibration));
  }

  Calibration with_mounting(Calibration result) const {
    Eigen::Isometry3d T_base_sensor = trajectory.T_base_camera();
    if (sensor.lidar) T_base_sensor = T_base_sensor * sensor.T_camera_lidar;
    if (config.wheels.enabled) {
      result.motion.T_sensor_base = Transform<Sensor, Base>(T_base_sensor.inverse());
    }
    if (config.imu.enabled) result.motion.T_sensor_imu = Transform<Sensor, Imu>(T_sensor_imu());
    return result;
  }

  Stage make_stage() const {
    Building building = build(config);
    const CameraMotion way(config, building, seconds);
    std::vector<Actor> actors = cast_actors(config, building, way, seconds);
    return Stage(std::move(building), std::move(actors));
  }

  /// The world is the first sensor frame of day 0 without another start.
  Eigen::Isometry3d first_pose() const {
    SceneConfig first_day = config;
    first_day.day = 0;
    first_day.start = 0.0;
    const CameraMotion way(first_day, stage.building(), seconds);
    const Eigen::Isometry3d T = way.T_building_camera(0.0);
    return sensor.lidar ? T * sensor.T_camera_lidar : T;
  }

  double seconds_at(int index) const { return index / sensor.hz; }

  Eigen::Isometry3d T_building_sensor(double at) const {
    const Eigen::Isometry3d T = trajectory.T_building_camera(at);
    return sensor.lidar ? T * sensor.T_camera_lidar : T;
  }

  /// Sharp view at `at`, and the light integrated over the exposure.
  ExactView expose(double at, Image<Eigen::Vector3f>& radiance) {
    const int samples = config.blur_samples;
    ExactView view;
    for (int i = 0; samples > 1 && i < samples; ++i) {
      const double share = (i + 0.5) / samples - 0.5;
      const double instant = at + share * sensor.color.exposure;
      stage.set(instant);
      stage.look(table, trajectory.T_building_camera(instant),
                 {.radiance = &radiance, .weight = kExposure / static_cast<float>(samples)});
    }
    stage.set(at);
    Image<Eigen::Vector3f>* sharp = samples > 1 ? nullptr : &radiance;
    stage.look(table, trajectory.T_building_camera(at),
               {.view = &view, .radiance = sharp, .weight = kExposure});
    return view;
  }

  std::vector<ObjectTruth> objects(double at, const ExactView& view) const {
    std::vector<ObjectTruth> found =
        visible_objects(stage, view, sensor.color.intrinsics, trajectory.T_building_camera(at));
    for (ObjectTruth& object : found) {
      const auto& motion = stage.actors()[static_cast<std::size_t>(object.id)].motion;
      Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
      velocity.head<2>() = motion.velocity(at);
      object.moving = velocity.norm() > kMovingSpeed;
      object.velocity = T_world_building.linear() * velocity;
      object.T_world_box = T_world_building * object.T_world_box;
    }
    return found;
  }

  ColorSensor color_sensor() const {
    ColorSensor color = sensor.color;
    if (!config.noise) color.read_noise = color.shot_noise = 0.0;
    return color;
  }
};

SimulatedScene::SimulatedScene(const SceneConfig& config) : impl_(std::make_unique<Impl>(config)) {}

SimulatedScene::~SimulatedScene() = default;

const SceneConfig& SimulatedScene::config() const {
  return impl_->config;
}

const SensorPreset& SimulatedScene::sensor() const {
  return impl_->sensor;
}

int SimulatedScene::size() const {
  const SceneConfig& config = impl_->config;
  if (config.frames > 0) return config.frames;
  return std::max(1, static_cast<int>(std::lround(config.duration * impl_->sensor.hz)));
}

const Calibration& SimulatedScene::calibration() const {
  return *impl_->calibration;
}

Timestamp SimulatedScene::stamp(int index) const {
  return Timestamp::from_seconds(impl_->seconds_at(index));
}

SimulatedFrame SimulatedScene::render(int index) {
  Impl& scene = *impl_;
  const double at = scene.seconds_at(index);
  const std::uint64_t key = daily_seed(scene.config, static_cast<std::uint64_t>(index));
  SimulatedFrame result;
  Frame& frame = result.frame;
  frame.index = index;
  frame.stamp = stamp(index);
  frame.name = frame.stamp.to_string();
  frame.calibration = scene.calibration;
  if (scene.sensor.lidar) {
    ExactScan exact = scan(
        scene.stage, *scene.sensor.lidar, index, 1.0 / scene.sensor.hz,
        [&](double t) { return scene.T_building_sensor(at + t); }, at, scene.config.noise,
        hash_of(key, 3));
    frame.scan = std::move(exact.scan);
    const Eigen::Isometry3f T = scene.T_world_building.cast<float>();
    for (const Eigen::Vector3f& point : exact.points) result.scan.points.push_back(T * point);
    result.scan.labels = std::move(exact.labels);
  }
  Image<Eigen::Vector3f> radiance(scene.table.width, scene.table.height, Eigen::Vector3f::Zero());
  result.exact = scene.expose(at, radiance);
  const bool dark = is_dark(scene.config, at);
  if (dark)
    radiance =
        Image<Eigen::Vector3f>(scene.table.width, scene.table.height, Eigen::Vector3f::Zero());
  result.objects = scene.objects(at, result.exact);
  if (dark) {
    result.exact.object = Image<std::uint8_t>(scene.table.width, scene.table.height);
    for (ObjectTruth& object : result.objects) {
      if (scene.sensor.lidar) break;  // needs no light
      object.pixels = 0;
      object.visible = {};
    }
  }
  frame.mask = label_image(scene.stage, result.exact);
  frame.color = develop(radiance, scene.color_sensor(), hash_of(key, 1));
  if (scene.sensor.depth) {
    frame.depth = scene.config.noise
                      ? measured_depth(result.exact, *scene.sensor.depth, hash_of(key, 2))
                      : ideal_depth(result.exact, *scene.sensor.depth);
    if (dark) frame.depth = Image<float>(frame.depth.width(), frame.depth.height());
  }
  return result;
}

StampedPose SimulatedScene::pose_at(Timestamp stamp) const {
  return {stamp, Transform<World, Sensor>(impl_->T_world_building *
                                          impl_->T_building_sensor(stamp.seconds()))};
}

StampedPose SimulatedScene::truth(int index) const {
  return pose_at(stamp(index));
}

MotionSamples SimulatedScene::motion() const {
  const SceneConfig& config = impl_->config;
  const auto seed = static_cast<std::uint64_t>(config.seed);
  const auto base = [this](double at) { return impl_->trajectory.T_building_base(at); };
  const auto imu = [this](double at) { return impl_->T_building_sensor(at) * T_sensor_imu(); };
  return {measure_wheels(base, impl_->seconds, config.wheels, hash_of(seed, 0x3ee1)),
          measure_imu(imu, impl_->seconds, config.imu, hash_of(seed, 0x13a0))};
}

TruthCloud SimulatedScene::static_cloud(double spacing) const {
  return sample(impl_->stage.building().mesh, impl_->T_world_building, spacing);
}

}  // namespace mms
