#include "tests/localization/box_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mms/geometry/camera.hpp"
#include "mms/geometry/depth_noise.hpp"
#include "mms/geometry/se3.hpp"

namespace mms::testing {
namespace {

constexpr float kSigma = 0.005F;

void add_crease(const BoxRoom& room, int axis, const Eigen::Isometry3d& T_sensor_world,
                std::vector<EdgeFeature>& edges) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  for (int corner = 0; corner < 4; ++corner) {
    Eigen::Vector3d p;
    p(u) = corner % 2 == 0 ? room.low(u) : room.high(u);
    p(v) = corner / 2 == 0 ? room.low(v) : room.high(v);
    for (p(axis) = room.low(axis) + 0.2; p(axis) < room.high(axis) - 0.2; p(axis) += 0.05) {
      edges.push_back({(T_sensor_world * p).cast<float>(), kSigma});
    }
  }
}

void push(LabeledCloud& cloud, const Eigen::Vector3d& point) {
  cloud.points.push_back(point.cast<float>());
  cloud.labels.push_back(PointLabel::kStatic);
  cloud.cluster.push_back(-1);
}

}  // namespace

BoxRoom::Hit BoxRoom::cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  double nearest = std::numeric_limits<double>::infinity();
  Hit hit{};
  for (int axis = 0; axis < 3; ++axis) {
    if (direction(axis) == 0.0) continue;
    const bool to_high = direction(axis) > 0.0;
    const double face = to_high ? high(axis) : low(axis);
    const double t = (face - origin(axis)) / direction(axis);
    if (t >= nearest) continue;
    nearest = t;
    hit.axis = axis;
    hit.point = origin + t * direction;
    hit.point(axis) = face;
    hit.normal = (to_high ? -1.0 : 1.0) * Eigen::Vector3d::Unit(axis);
  }
  return hit;
}

double BoxRoom::distance_to_face(const Eigen::Vector3d& point) const {
  return (point - low).cwiseAbs().cwiseMin((point - high).cwiseAbs()).minCoeff();
}

Eigen::Vector3d BoxRoom::on_crease(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d to_face = (point - low).cwiseAbs().cwiseMin((point - high).cwiseAbs());
  int along = 0;
  to_face.maxCoeff(&along);
  Eigen::Vector3d nearest = point;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == along) continue;
    const bool at_low = std::abs(point(axis) - low(axis)) < std::abs(point(axis) - high(axis));
    nearest(axis) = at_low ? low(axis) : high(axis);
  }
  return nearest;
}

double BoxRoom::distance_to_crease(const Eigen::Vector3d& point) const {
  return (point - on_crease(point)).norm();
}

double texture(const Eigen::Vector3d& p) {
  return 128.0 + 40.0 * std::sin(5.0 * p.x() + 2.0 * p.z()) +
         40.0 * std::sin(6.0 * p.y() - 3.0 * p.z() + 1.0) +
         20.0 * std::sin(11.0 * p.z() + 3.0 * p.x());
}

CameraIntrinsics box_camera() {
  return {.fx = 130.0, .fy = 130.0, .cx = 79.5, .cy = 59.5, .width = 160, .height = 120};
}

LabeledCloud organised_cloud(const BoxRoom& room, const Eigen::Isometry3d& T_world_sensor,
                             double noise, unsigned seed) {
  LabeledCloud cloud;
  cloud.camera = box_camera();
  cloud.width = cloud.camera.width;
  cloud.height = cloud.camera.height;
  cloud.dynamic_pixels = Image<std::uint8_t>(cloud.width, cloud.height);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const CameraModel camera(cloud.camera);
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const Eigen::Vector3d ray = camera.ray({x, y});
      const auto hit = room.cast(T_world_sensor.translation(), T_world_sensor.linear() * ray);
      const double exact = (T_world_sensor.inverse() * hit.point).z();
      const double depth = exact + noise * DepthNoise{}.sigma(exact) * normal(random);
      push(cloud, depth * ray);
      const auto grey = static_cast<std::uint8_t>(std::lround(texture(hit.point)));
      cloud.colors.push_back({grey, grey, grey});
    }
  }
  return cloud;
}

LabeledCloud spinning_scan(const BoxRoom& room, const Eigen::Isometry3d& T_world_sensor, int rings,
                           double noise, unsigned seed) {
  LabeledCloud cloud = moving_scan(
      room, [&](double) { return T_world_sensor; }, 0.1, rings, noise, seed);
  cloud.time_offset.clear();
  return cloud;
}

LabeledCloud moving_scan(const BoxRoom& room, const std::function<Eigen::Isometry3d(double)>& pose,
                         double period, int rings, double noise, unsigned seed) {
  constexpr int kColumns = 600;
  LabeledCloud cloud;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  for (int column = 0; column < kColumns; ++column) {
    const double azimuth = 2.0 * M_PI * column / kColumns;
    const double seconds = period * column / kColumns;
    const Eigen::Isometry3d T_world_sensor = pose(seconds);
    for (int ring = 0; ring < rings; ++ring) {
      const double elevation = (-25.0 + 50.0 * ring / (rings - 1)) * M_PI / 180.0;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const auto hit = room.cast(T_world_sensor.translation(), T_world_sensor.linear() * ray);
      const double range = (hit.point - T_world_sensor.translation()).norm();
      push(cloud, (range + normal(random)) * ray);
      cloud.time_offset.push_back(static_cast<float>(seconds));
    }
  }
  cloud.width = static_cast<int>(cloud.points.size());
  cloud.height = 1;
  return cloud;
}

FeatureCloud exact_features(const BoxRoom& room, const Eigen::Isometry3d& T_world_sensor,
                            int density, double margin) {
  const Eigen::Isometry3d T_sensor_world = T_world_sensor.inverse();
  FeatureCloud features;
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < density * density; ++i) {
      Eigen::Vector3d direction;
      direction(face % 3) = face < 3 ? 1.0 : -1.0;
      direction((face + 1) % 3) = 2.0 * (i % density + 0.5) / density - 1.0;
      direction((face + 2) % 3) = 2.0 * (i / density + 0.5) / density - 1.0;
      const auto hit = room.cast(T_world_sensor.translation(), direction);
      if (room.distance_to_crease(hit.point) < margin) continue;
      features.planes.push_back({(T_sensor_world * hit.point).cast<float>(),
                                 (T_sensor_world.linear() * hit.normal).cast<float>(), kSigma});
    }
  }
  for (int axis = 0; axis < 3; ++axis) add_crease(room, axis, T_sensor_world, features.edges);
  return features;
}

void add_noise(FeatureCloud& features, double sigma, std::mt19937& random) {
  std::normal_distribution<float> normal(0.0F, static_cast<float>(sigma));
  for (PlaneFeature& plane : features.planes) {
    plane.point += normal(random) * plane.point.normalized();
  }
  for (EdgeFeature& edge : features.edges) {
    for (int k = 0; k < 3; ++k) edge.point(k) += normal(random);
  }
}

void add_outliers(FeatureCloud& features, double share, double distance, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto offset = [&] {
    const Eigen::Vector3d any = Eigen::Vector3d::NullaryExpr([&] { return unit(random) - 0.5; });
    return Eigen::Vector3f((distance * unit(random) * any.normalized()).cast<float>());
  };
  for (PlaneFeature& plane : features.planes) {
    if (unit(random) < share) plane.point += offset();
  }
  for (EdgeFeature& edge : features.edges) {
    if (unit(random) < share) edge.point += offset();
  }
}

Eigen::Isometry3d motion(double x, double y, double z, double rx, double ry, double rz) {
  Vector6d tangent;
  tangent << x, y, z, rx, ry, rz;
  return se3::exp(tangent);
}

double position_error(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.inverse() * b).translation().norm();
}

double angle_error_deg(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return se3::angle(a.inverse() * b) * 180.0 / M_PI;
}

}  // namespace mms::testing
