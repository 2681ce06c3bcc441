#include "mms/simulation/world/actors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mms/core/random_stream.hpp"
#include "mms/simulation/people/person_model.hpp"
#include "mms/simulation/vehicles/agv_model.hpp"
#include "mms/simulation/world/carrying.hpp"
#include "mms/simulation/world/route.hpp"

namespace mms {
namespace {

constexpr double kRobotRadius = 0.5;    // [m]
constexpr double kPersonRadius = 0.24;  // they pass closely [m]
constexpr double kAgvRadius = 1.0;      // [m]
constexpr int kTries = 100;

/// A position on a lane and its direction there.
struct Station {
  Eigen::Vector2d position;
  Eigen::Vector2d along;
  Eigen::Vector2d across() const { return {-along.y(), along.x()}; }
};

/// The lane's center line, parameterized by the distance [m] from the sensor's start.
class Lane {
 public:
  /// @param start  known place of the sensor's start; 0: the nearest one
  Lane(const Building& building, const Motion& robot, double start)
      : closed_(building.lane_closed), corners_(building.lane) {
    if (closed_) corners_.push_back(corners_.front());
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      length_ += (corners_[i] - corners_[i - 1]).norm();
    }
    double nearest = std::numeric_limits<double>::max();
    const double count = 400.0;
    for (double i = 0.0; i < count; ++i) {
      const double along = length_ * i / count;
      const double distance = (raw(along).position - robot.position(0.0)).norm();
      if (distance < nearest) {
        nearest = distance;
        begin_ = along;
      }
    }
    if (start > 0.0) begin_ = start;
  }

  double length() const { return length_; }
  bool closed() const { return closed_; }
  double begin() const { return begin_; }
  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }

  Station at(double metres) const { return raw(begin_ + metres); }

 private:
  Station raw(double along) const {
    if (closed_) along -= length_ * std::floor(along / length_);
    along = std::clamp(along, 0.0, length_);
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      const Eigen::Vector2d step = corners_[i] - corners_[i - 1];
      const double part = step.norm();
      if (along <= part || i + 1 == corners_.size()) {
        return {corners_[i - 1] + step * (along / part), step / part};
      }
      along -= part;
    }
    return {};
  }

  bool closed_;
  std::vector<Eigen::Vector2d> corners_;
  double length_ = 0.0;
  double begin_ = 0.0;
};

/// Places actors one by one without collisions of their trajectories.
class Casting {
 public:
  Casting(const SceneConfig& config, const Building& building, const CameraMotion& camera,
          double seconds)
      : config_(config),
        building_(building),
        way_(camera.way()),
        robot_(camera.robot()),
        seconds_(seconds),
        lane_(building, robot_, config.start),
        random_(daily_seed(config, 0xac7)) {}

  std::vector<Actor> all() {
    for (int i = 0; i < config_.companions; ++i) add_person([&, i] { return companion(i); });
    for (int i = 0; i < config_.leading; ++i) add_person([&] { return leading(3.2 + 1.2 * i); });
    for (int i = 0; i < config_.agvs; ++i) add_agv(i);
    for (int i = 0; i < config_.oncoming; ++i) add_person([&] { return oncoming(-1.0); });
    for (int i = 0; i < config_.crossing; ++i) {
      add_person([&, i] { return crossing(i, config_.crossing); });
    }
    for (int i = 0; i < config_.working; ++i) add_worker();
    return std::move(actors_);
  }

 private:
  double between(double from, double to) {
    return static_cast<double>(random_.between(static_cast<float>(from), static_cast<float>(to)));
  }

  /// Path length of the sensor on the lane.
  double reach() const { return robot_.travelled(seconds_); }

  Route walk(double speed) {
    Route route;
    route.speed = speed;
    route.acceleration = 1.2;
    route.turn_rate = 2.4;
    route.look_ahead = 0.5;
    route.pause_share = config_.pause_share;
    route.pause = config_.pause;
    route.seed = random_.bits();
    return route;
  }

  /// Repeated crossing of the lane at the i-th of `count` positions along the sensor's path.
  Motion crossing(int i, int count) {
    const double stretch = std::max(0.0, reach() + config_.crossing_beyond - config_.crossing_from);
    const double spacing = stretch / count;
    const double along = config_.crossing_from + (i + between(0.1, 0.9)) * spacing;
    const Station place = lane_.at(along);
    Route route = walk(between(0.8, 1.4));
    const double half = building_.lane_half_width + between(-0.2, 0.3);
    const Eigen::Vector2d slant = between(-1.0, 1.0) * std::min(0.8, 2.0 * spacing) * place.along;
    route.corners = {place.position - half * place.across() - slant,
                     place.position + half * place.across() + slant};
    route.end = RouteEnd::kToAndFro;
    route.start = between(0.0, 2.0 * length_of(route));
    return drive(route, seconds_);
  }

  /// The lane's corners with a lateral offset, from the sensor's start on.
  std::vector<Eigen::Vector2d> lane_corners(double aside) const {
    std::vector<Eigen::Vector2d> corners;
    const std::vector<Eigen::Vector2d>& center = lane_.corners();
    const std::size_t count = lane_.closed() ? center.size() - 1 : center.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector2d before =
          i == 0 && !lane_.closed() ? center[0] : center[(i + count - 1) % count];
      const Eigen::Vector2d after =
          i + 1 == count && !lane_.closed() ? center[i] : center[(i + 1) % count];
      const Eigen::Vector2d in = (center[i] - before).norm() > 0.0
                                     ? Eigen::Vector2d((center[i] - before).normalized())
                                     : Eigen::Vector2d((after - center[i]).normalized());
      const Eigen::Vector2d out =
          (after - center[i]).norm() > 0.0 ? Eigen::Vector2d((after - center[i]).normalized()) : in;
      Eigen::Vector2d side(-in.y() - out.y(), in.x() + out.x());
      side /= std::max(1e-9, 0.5 * side.squaredNorm());
      corners.push_back(center[i] + aside * side);
    }
    return corners;
  }

  /// They alternate between left and right.
  Motion companion(int i) {
    const double left = i % 2 == 0 ? 1.0 : -1.0;
    return accompany(config_, way_, seconds_,
                     {between(1.3, 2.0) / config_.speed, left * between(0.0, 0.6)});
  }

  Motion leading(double ahead) {
    Route route = walk(config_.speed);
    route.pause_share = 0.0;
    route.acceleration = 0.5;
    route.corners = lane_corners(between(-0.5, 0.5));
    route.end = lane_.closed() ? RouteEnd::kLoop : RouteEnd::kStop;
    route.start = lane_.begin() + ahead + between(0.0, 1.0);
    return drive(route, seconds_);
  }

  Motion oncoming(double aside) {
    Route route = walk(between(0.7, 1.3));
    route.corners = lane_corners(aside + between(-0.15, 0.15));
    std::reverse(route.corners.begin(), route.corners.end());
    route.end = lane_.closed() ? RouteEnd::kLoop : RouteEnd::kToAndFro;
    route.start = between(0.0, length_of(route));
    return drive(route, seconds_);
  }

  /// Vehicles alternate: towards the sensor, ahead of it, crossing, parked beside the lane.
  Motion vehicle(int i) {
    if (i % 4 == 1) return leading_vehicle();
    if (i % 4 == 2) return crossing(i, std::max(4, config_.agvs));
    if (i % 4 == 3) return parked();
    return oncoming(building_.vehicle_aside);
  }

  Motion leading_vehicle() {
    Route route = walk(config_.speed);
    route.acceleration = 0.4;
    route.turn_rate = 0.9;
    route.corners = lane_corners(1.1);
    route.end = lane_.closed() ? RouteEnd::kLoop : RouteEnd::kStop;
    route.start = lane_.begin() + between(4.0, 7.0);
    return drive(route, seconds_);
  }

  Motion parked() {
    const Station place = lane_.at(between(3.0, std::max(5.0, reach())));
    const Eigen::Vector2d position =
        place.position - (building_.lane_half_width - 0.1) * place.across();
    return Motion::still(position, std::atan2(place.along.y(), place.along.x()));
  }

  void add_agv(int i) {
    const auto kind = static_cast<AgvKind>(i % 5);
    const std::uint64_t seed = random_.bits();
    const double radius = kind == AgvKind::kPioneer ? 0.35 : kAgvRadius;
    add(
        radius, [&] { return vehicle(i); }, [&] { return make_agv(kind, seed); });
  }

  template <class Way>
  void add_person(const Way& way) {
    const std::uint64_t seed = random_.bits();
    add(kPersonRadius, way, [&] { return make_person(random_person_style(seed)); });
  }

  void add_worker() {
    if (building_.workplaces.empty()) return;
    PersonStyle style = random_person_style(random_.bits());
    style.working = true;
    style.carries_box = false;
    add(
        kPersonRadius, [&] { return workplace(); }, [&] { return make_person(style); });
  }

  Motion workplace() {
    const Workplace& place = building_.workplaces[random_.below(building_.workplaces.size())];
    return Motion::still(place.position, place.yaw);
  }

  template <class Way, class Make>
  void add(double radius, const Way& way, const Make& make) {
    for (int i = 0; i < kTries; ++i) {
      Motion motion = way();
      if (!is_clear(motion, radius)) continue;
      actors_.push_back({make(), std::move(motion)});
      radii_.push_back(radius);
      return;
    }
  }

  bool is_clear(const Motion& motion, double radius) const {
    for (double t = 0.0; t <= seconds_; t += 0.2) {
      if (config_.carried && is_dark(config_, t)) continue;  // nobody sees who is carried through
      const Eigen::Vector2d here = motion.position(t);
      const double distance = (here - robot_.position(t)).norm();
      if (distance < radius + kRobotRadius) return false;
      if (distance > building_.care) continue;
      for (std::size_t i = 0; i < actors_.size(); ++i) {
        if ((here - actors_[i].motion.position(t)).norm() < radius + radii_[i]) return false;
      }
    }
    return true;
  }

  const SceneConfig& config_;
  const Building& building_;
  const Motion& way_;
  const Motion& robot_;
  double seconds_;
  Lane lane_;
  RandomStream random_;
  std::vector<Actor> actors_;
  std::vector<double> radii_;
};

}  // namespace

std::vector<Actor> cast_actors(const SceneConfig& config, const Building& building,
                               const CameraMotion& camera, double seconds) {
  return Casting(config, building, camera, seconds).all();
}

}  // namespace mms
