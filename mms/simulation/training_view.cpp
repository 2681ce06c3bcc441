#include "mms/simulation/training_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "mms/core/random_stream.hpp"
#include "mms/simulation/people/person_model.hpp"
#include "mms/simulation/truth/object_visibility.hpp"
#include "mms/simulation/vehicles/agv_model.hpp"
#include "mms/simulation/world/stage.hpp"

namespace mms {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kViewsPerWorld = 8;
constexpr int kPersons = 6;
constexpr int kAgvs = 5;
constexpr std::size_t kMaxObjects = 7;
constexpr double kPersonRadius = 0.35;  // [m]
constexpr double kAgvRadius = 0.9;      // [m]
constexpr double kPi = std::numbers::pi;

double between(RandomStream& random, double from, double to) {
  return static_cast<double>(random.between(static_cast<float>(from), static_cast<float>(to)));
}

/// Random colors, so that the network does not learn them.
void repaint(Mesh& mesh, RandomStream& random) {
  const float strength = random.between(0.0F, 0.6F);
  for (Material& material : mesh.materials) {
    for (int channel = 0; channel < 3; ++channel) {
      const float factor = 1.0F + strength * random.between(-1.0F, 1.0F);
      material.color[channel] = std::min(1.0F, material.color[channel] * factor);
      material.second[channel] = std::min(1.0F, material.second[channel] * factor);
    }
  }
}

void relight(Lights& lights, RandomStream& random) {
  const float strength = random.between(0.4F, 1.3F);
  const Eigen::Vector3f tint(random.between(0.85F, 1.1F), 1.0F, random.between(0.75F, 1.15F));
  for (Lamp& lamp : lights.lamps) {
    const float own = random.chance(0.15F) ? 0.05F : strength * random.between(0.6F, 1.3F);
    lamp.color = own * lamp.color.cwiseProduct(tint);
  }
  const float scattered = random.between(0.3F, 1.4F);
  lights.above *= scattered;
  lights.below *= scattered;
}

std::vector<Actor> random_actors(RandomStream& random) {
  std::vector<Actor> actors;
  const Motion nowhere = Motion::still({0.0, 0.0}, 0.0);
  for (int i = 0; i < kPersons; ++i) {
    PersonStyle style = random_person_style(random.bits());
    style.working = random.chance(0.25F);
    actors.push_back({make_person(style), nowhere});
  }
  for (int i = 0; i < kAgvs; ++i) {
    actors.push_back({make_agv(static_cast<AgvKind>(i), random.bits()), nowhere});
  }
  return actors;
}

std::unique_ptr<Stage> random_stage(RandomStream& random) {
  SceneConfig config;
  const float layout = random.uniform();
  config.layout = layout < 0.6F   ? Layout::kHall
                  : layout < 0.8F ? Layout::kAisle
                                  : Layout::kCorridor;
  config.seed = static_cast<int>(random.seed() % 1000000U);
  config.clutter = between(random, 0.3, 1.0);
  Building building = build(config);
  repaint(building.mesh, random);
  relight(building.lights, random);
  return std::make_unique<Stage>(std::move(building), random_actors(random));
}

/// A pose on the floor with a constant velocity.
struct Course {
  Vector2d position{0.0, 0.0};
  double yaw = 0.0;
  double speed = 0.0;  ///< along the heading [m/s]

  Isometry3d pose(double seconds) const {
    Isometry3d T = Isometry3d::Identity();
    T.linear() = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
    T.translation().head<2>() = position + seconds * speed * Vector2d(std::cos(yaw), std::sin(yaw));
    return T;
  }
};

/// Pose of the camera, and its motion during the exposure.
struct CameraHold {
  Course course;
  double height = 1.0;
  double pitch = 0.0;
  double roll = 0.0;
  double turn_rate = 0.0;  ///< [rad/s]

  Isometry3d T_building_camera(double seconds) const {
    Isometry3d T = course.pose(seconds);
    T.translate(Vector3d(0.0, 0.0, height));
    T.rotate(Eigen::AngleAxisd(turn_rate * seconds, Vector3d::UnitZ()));
    T.rotate(Eigen::AngleAxisd(pitch, Vector3d::UnitY()));
    T.rotate(Eigen::AngleAxisd(roll, Vector3d::UnitX()));
    Eigen::Matrix3d optical;
    optical << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
    T.linear() = T.linear() * optical;
    return T;
  }
};

/// Whether a disc on the floor is free of walls and stock, checked by radial rays.
bool is_free(const Stage& stage, const Vector2d& position, double radius) {
  std::vector<Ray> rays;
  for (const float height : {0.25F, 0.9F, 1.5F}) {
    for (int i = 0; i < 8; ++i) {
      const double angle = 0.25 * kPi * i;
      const Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
      const Eigen::Vector3f origin(static_cast<float>(position.x()),
                                   static_cast<float>(position.y()), height);
      rays.push_back({origin, direction.cast<float>(), static_cast<float>(radius)});
    }
  }
  std::vector<std::uint8_t> blocked(rays.size());
  stage.rays().blocked(rays, blocked);
  return std::none_of(blocked.begin(), blocked.end(), [](auto b) { return b != 0; });
}

ColorSensor random_camera(RandomStream& random) {
  ColorSensor color = sensor_preset(sensor_names()[random.below(3)]).color;
  const double zoom = between(random, 0.75, 1.3);
  color.intrinsics.fx *= zoom;
  color.intrinsics.fy *= zoom;
  color.exposure = between(random, 0.002, 0.03);
  color.read_noise *= between(random, 0.5, 3.0);
  color.shot_noise *= between(random, 0.5, 3.0);
  color.vignetting = between(random, 0.0, 0.4);
  color.softness = between(random, 0.3, 1.2);
  return color;
}

/// The scene of one image: positions of all objects.
class View {
 public:
  View(Stage& stage, RandomStream& random)
      : stage_(stage),
        random_(random),
        courses_(stage.actors().size()),
        activities_(stage.actors().size()) {
    stage_.set(std::vector<Isometry3d>(courses_.size(), hidden()), activities_);
    hold_camera();
    const std::size_t count = random_.below(kMaxObjects + 1);
    for (std::size_t i = 0; i < count; ++i) place(random_.below(courses_.size()));
  }

  const CameraHold& camera() const { return camera_; }

  void set(double seconds) {
    std::vector<Isometry3d> poses;
    for (const auto& course : courses_) poses.push_back(course ? course->pose(seconds) : hidden());
    stage_.set(std::move(poses), activities_);
  }

  bool is_placed(int id) const { return courses_[static_cast<std::size_t>(id)].has_value(); }

 private:
  static Isometry3d hidden() {
    Isometry3d T = Isometry3d::Identity();
    T.translation().z() = -500.0;
    return T;
  }

  double radius_of(std::size_t actor) const {
    return stage_.actors()[actor].model->object_class() == ObjectClass::kPerson ? kPersonRadius
                                                                                : kAgvRadius;
  }

  void hold_camera() {
    const Building& building = stage_.building();
    for (int i = 0; i < 50; ++i) {
      const std::size_t corner = random_.below(building.lane.size());
      const Vector2d from = building.lane[corner];
      const Vector2d to = building.lane[(corner + 1) % building.lane.size()];
      camera_.course.position = from + between(random_, 0.0, 1.0) * (to - from) +
                                building.lane_half_width * Vector2d(between(random_, -1.0, 1.0),
                                                                    between(random_, -1.0, 1.0));
      if (is_free(stage_, camera_.course.position, 0.3)) break;
    }
    camera_.course.yaw = between(random_, -kPi, kPi);
    camera_.course.speed = between(random_, 0.0, 1.0);
    camera_.height = between(random_, 0.3, 1.8);
    camera_.pitch = between(random_, -0.25, 0.3) * (0.4 + 0.6 * camera_.height);
    camera_.roll = between(random_, -0.06, 0.06);
    camera_.turn_rate = random_.chance(0.4F) ? between(random_, -1.2, 1.2) : 0.0;
  }

  void place(std::size_t actor) {
    if (courses_[actor]) return;
    for (int i = 0; i < 30; ++i) {
      const Course course = random_course();
      if (!fits(actor, course)) continue;
      courses_[actor] = course;
      activities_[actor] = {between(random_, 0.0, 60.0), between(random_, 0.0, 10.0),
                            std::abs(course.speed)};
      return;
    }
  }

  Course random_course() {
    constexpr double kHalfView = 0.6;  // slightly more than half the field of view [rad]
    const double distance = 0.5 * std::exp(between(random_, 0.0, std::log(24.0)));
    const double bearing = camera_.course.yaw + between(random_, -kHalfView, kHalfView);
    Course course;
    course.position =
        camera_.course.position + distance * Vector2d(std::cos(bearing), std::sin(bearing));
    course.yaw = between(random_, -kPi, kPi);
    course.speed = random_.chance(0.4F) ? 0.0 : between(random_, 0.4, 1.7);
    return course;
  }

  bool fits(std::size_t actor, const Course& course) const {
    const double radius = radius_of(actor);
    if ((course.position - camera_.course.position).norm() < radius + 0.2) return false;
    for (std::size_t i = 0; i < courses_.size(); ++i) {
      if (!courses_[i]) continue;
      const double apart = 0.75 * (radius + radius_of(i));
      if ((courses_[i]->position - course.position).norm() < apart) return false;
    }
    return is_free(stage_, course.position, radius);
  }

  Stage& stage_;
  RandomStream& random_;
  CameraHold camera_;
  std::vector<std::optional<Course>> courses_;
  std::vector<Activity> activities_;
};

}  // namespace

struct TrainingViews::Impl {
  std::uint64_t seed;
  int world = -1;
  std::unique_ptr<Stage> stage;

  Stage& stage_of(int index) {
    if (world != index / kViewsPerWorld) {
      world = index / kViewsPerWorld;
      RandomStream random(hash_of(seed, static_cast<std::uint64_t>(world)));
      stage = random_stage(random);
    }
    return *stage;
  }
};

TrainingViews::TrainingViews(std::uint64_t seed)
    : impl_(std::make_unique<Impl>(Impl{seed, -1, nullptr})) {}

TrainingViews::~TrainingViews() = default;

SimulatedFrame TrainingViews::render(int index) {
  Stage& stage = impl_->stage_of(index);
  RandomStream random(hash_of(impl_->seed + 1, static_cast<std::uint64_t>(index)));
  const ColorSensor color = random_camera(random);
  View view(stage, random);
  const RayTable table = ray_table(color.intrinsics);
  const int samples = random.chance(0.5F) ? 5 : 1;
  const float exposure = random.between(0.5F, 1.5F);
  Image<Eigen::Vector3f> radiance(table.width, table.height, Eigen::Vector3f::Zero());
  SimulatedFrame result;
  for (int i = 0; i < samples; ++i) {
    // An odd number of instants: the center one is that of the ground truth.
    const double at = ((i + 0.5) / samples - 0.5) * color.exposure;
    const bool center = i == samples / 2;
    view.set(at);
    stage.look(table, view.camera().T_building_camera(at),
               {.view = center ? &result.exact : nullptr,
                .radiance = &radiance,
                .weight = exposure / static_cast<float>(samples)});
  }
  view.set(0.0);
  const Isometry3d T_building_camera = view.camera().T_building_camera(0.0);
  for (ObjectTruth& object :
       visible_objects(stage, result.exact, color.intrinsics, T_building_camera)) {
    if (!view.is_placed(object.id)) continue;
    object.T_world_box = T_building_camera.inverse() * object.T_world_box;
    result.objects.push_back(std::move(object));
  }
  auto calibration = std::make_shared<Calibration>();
  calibration->camera = color.intrinsics;
  result.frame.index = index;
  result.frame.name = "view_" + std::to_string(index);
  result.frame.calibration = std::move(calibration);
  result.frame.color = develop(radiance, color, random.bits());
  result.frame.mask = label_image(stage, result.exact);
  return result;
}

}  // namespace mms
