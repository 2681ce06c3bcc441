#include "mms/core/transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

namespace mms {
namespace {

const double kQuarter = M_PI / 2.0;

template <class Target, class Source>
Transform<Target, Source> quarter_turn_about_z(const Eigen::Vector3d& translation) {
  return Transform<Target, Source>(Eigen::Translation3d(translation) *
                                   Eigen::AngleAxisd(kQuarter, Eigen::Vector3d::UnitZ()) *
                                   Eigen::Isometry3d::Identity());
}

template <class A, class B>
concept Composable = requires(const A& a, const B& b) {
  a* b;
};

TEST(Transform, MapsPointsFromSourceToTarget) {
  const auto T_world_sensor = quarter_turn_about_z<World, Sensor>({1.0, 2.0, 3.0});
  const Eigen::Vector3d in_world = T_world_sensor * Eigen::Vector3d(1.0, 0.0, 0.5);
  EXPECT_TRUE(in_world.isApprox(Eigen::Vector3d(1.0, 3.0, 3.5), 1e-15));
}

TEST(Transform, CompositionAppliesRightTransformFirst) {
  const auto T_world_camera = quarter_turn_about_z<World, Camera>({1.0, 0.0, 0.0});
  const Transform<Camera, Lidar> T_camera_lidar(
      Eigen::Isometry3d(Eigen::Translation3d(0.0, 5.0, 0.0)));
  const Transform<World, Lidar> T_world_lidar = T_world_camera * T_camera_lidar;
  const Eigen::Vector3d p(0.5, 0.0, 0.0);
  EXPECT_TRUE((T_world_lidar * p).isApprox(T_world_camera * (T_camera_lidar * p), 1e-15));
  EXPECT_TRUE((T_world_lidar * p).isApprox(Eigen::Vector3d(-4.0, 0.5, 0.0), 1e-15));
}

TEST(Transform, InverseSwapsFrames) {
  const auto T_world_sensor = quarter_turn_about_z<World, Sensor>({1.0, 2.0, 3.0});
  static_assert(std::is_same_v<decltype(T_world_sensor.inverse()), Transform<Sensor, World>>);
  const Transform<World, World> identity = T_world_sensor * T_world_sensor.inverse();
  EXPECT_TRUE(identity.isometry().isApprox(Eigen::Isometry3d::Identity(), 1e-15));
}

TEST(Transform, MismatchedFramesDoNotCompile) {
  static_assert(Composable<Transform<World, Camera>, Transform<Camera, Lidar>>);
  static_assert(!Composable<Transform<World, Camera>, Transform<Lidar, Camera>>);
  static_assert(!Composable<Transform<World, Sensor>, Transform<World, Sensor>>);
  static_assert(!std::is_convertible_v<Eigen::Isometry3d, Transform<World, Sensor>>);
}

TEST(Transform, DetectsNonFiniteValues) {
  EXPECT_TRUE((Transform<World, Sensor>().is_finite()));
  Eigen::Isometry3d not_finite = Eigen::Isometry3d::Identity();
  not_finite.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((Transform<World, Sensor>(not_finite).is_finite()));
  not_finite.translation().x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE((Transform<World, Sensor>(not_finite).is_finite()));
}

}  // namespace
}  // namespace mms
