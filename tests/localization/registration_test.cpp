#include "mms/localization/registration/registration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::angle_error_deg;
using testing::BoxRoom;
using testing::motion;
using testing::position_error;

const Eigen::Isometry3d kOrigin = Eigen::Isometry3d::Identity();

/// Features on the three faces that meet in one corner of the room, and on its three creases.
FeatureCloud corner_of(const FeatureCloud& all, const BoxRoom& room,
                       const Eigen::Isometry3d& T_world_sensor) {
  const auto at_corner = [&](const Eigen::Vector3f& point) {
    const Eigen::Vector3d p = T_world_sensor * point.cast<double>();
    return (p - room.low).cwiseAbs().minCoeff() < 1e-4;
  };
  const auto on_others = [&](const Eigen::Vector3f& point) {
    const Eigen::Vector3d p = T_world_sensor * point.cast<double>();
    return (p - room.high).cwiseAbs().minCoeff() < 1e-4;
  };
  FeatureCloud corner;
  for (const auto& f : all.planes) {
    if (at_corner(f.point)) corner.planes.push_back(f);
  }
  for (const auto& f : all.edges) {
    if (at_corner(f.point) && !on_others(f.point)) corner.edges.push_back(f);
  }
  return corner;
}

/// Planar features on the faces along the given axes only.
FeatureCloud faces_along(const FeatureCloud& all, const Eigen::Isometry3d& T_world_sensor,
                         std::initializer_list<int> axes) {
  FeatureCloud selected;
  for (const auto& f : all.planes) {
    const Eigen::Vector3d normal = T_world_sensor.linear() * f.normal.cast<double>();
    for (const int axis : axes) {
      if (std::abs(normal(axis)) > 0.99) selected.planes.push_back(f);
    }
  }
  return selected;
}

LocalMaps map_of(const FeatureCloud& features, Association association, double voxel = 0.2) {
  LocalMaps maps(voxel, 100000);
  maps.insert(features, kOrigin, association);
  return maps;
}

RegistrationConfig config_with(Association association) {
  RegistrationConfig config;
  config.geometric.association = association;
  return config;
}

class RegisteredBy : public ::testing::TestWithParam<Association> {};
INSTANTIATE_TEST_SUITE_P(Registration, RegisteredBy,
                         ::testing::Values(Association::kPaper, Association::kSurface),
                         testing::association_name);

TEST_P(RegisteredBy, RecoversKnownMotionInCorner) {
  const BoxRoom room;
  const LocalMaps maps =
      map_of(corner_of(exact_features(room, kOrigin, 60), room, kOrigin), GetParam());
  for (const Eigen::Isometry3d& truth :
       {motion(0.05, -0.03, 0.04, 0.02, -0.03, 0.01), motion(-0.02, 0.06, 0.0, -0.03, 0.0, 0.03)}) {
    const FeatureCloud frame = corner_of(exact_features(room, truth, 31), room, truth);
    ASSERT_GT(frame.planes.size(), 300U);
    const auto result =
        register_frame(frame, {maps, {}}, {kOrigin}, config_with(GetParam()), DepthNoise{});
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.degenerate_directions, 0);
    EXPECT_LT(position_error(result.T_world_sensor, truth), 1e-3);
    EXPECT_LT(angle_error_deg(result.T_world_sensor, truth), 0.02);
    EXPECT_GT(result.geometric.planes.inliers, 300);
    EXPECT_GT(result.geometric.edges.inliers, 100);
  }
}

/// 5 mm of noise, 30 % outliers of up to half a metre. 3000 features of 5 mm leave a standard
/// deviation under 0.3 mm; the bounds are ten times that.
TEST_P(RegisteredBy, ToleratesNoiseAndOutliers) {
  const BoxRoom room;
  const Eigen::Isometry3d truth = motion(0.05, -0.03, 0.04, 0.02, -0.03, 0.01);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::mt19937 random(seed);
    FeatureCloud map_features = exact_features(room, kOrigin, 60);
    testing::add_noise(map_features, 0.005, random);
    FeatureCloud frame = exact_features(room, truth, 31);
    testing::add_noise(frame, 0.005, random);
    testing::add_outliers(frame, 0.3, 0.5, random);
    const LocalMaps maps = map_of(map_features, GetParam());
    const auto result =
        register_frame(frame, {maps, {}}, {kOrigin}, config_with(GetParam()), DepthNoise{});
    EXPECT_LT(position_error(result.T_world_sensor, truth), 0.003) << seed;
    EXPECT_LT(angle_error_deg(result.T_world_sensor, truth), 0.1) << seed;
  }
}

TEST_P(RegisteredBy, SinglePlaneLeavesThreeDirectionsToPrediction) {
  const BoxRoom room;
  const auto floor = [&](const Eigen::Isometry3d& T, int density) {
    FeatureCloud all = faces_along(exact_features(room, T, density), T, {1});
    std::erase_if(all.planes,
                  [&](const PlaneFeature& f) { return (T * f.point.cast<double>()).y() < 0.0; });
    return all;
  };
  const LocalMaps maps = map_of(floor(kOrigin, 60), GetParam());
  const Eigen::Isometry3d truth = motion(0.0, 0.03, 0.0, 0.02, 0.0, -0.015);
  const Eigen::Isometry3d prediction = motion(0.02, 0.0, -0.03, 0.0, 0.01, 0.0);
  const auto result = register_frame(floor(truth, 31), {maps, {}}, {prediction},
                                     config_with(GetParam()), DepthNoise{});
  EXPECT_EQ(result.degenerate_directions, 3);
  const Eigen::Isometry3d& T = result.T_world_sensor;
  // Translation along the normal (y) is measured; the other directions are predicted.
  const Eigen::Vector3d floor_point = truth.inverse() * Eigen::Vector3d(0.0, room.high.y(), 1.0);
  EXPECT_NEAR((T * floor_point).y(), room.high.y(), 1e-3);
  EXPECT_LT((T.linear().row(1) - truth.linear().row(1)).norm(), 1e-3);
  EXPECT_NEAR(T.translation().x(), prediction.translation().x(), 2e-3);
  EXPECT_NEAR(T.translation().z(), prediction.translation().z(), 2e-3);
  const double yaw = std::atan2(T.linear()(0, 2), T.linear()(2, 2));
  EXPECT_NEAR(yaw, 0.01, 1e-3);
}

TEST_P(RegisteredBy, CorridorLeavesLengthToPrediction) {
  const BoxRoom room;
  // No features near creases: planes through points of two walls would constrain the length.
  const auto corridor = [&](const Eigen::Isometry3d& T, int density) {
    return faces_along(exact_features(room, T, density, 0.45), T, {0, 1});
  };
  const LocalMaps maps = map_of(corridor(kOrigin, 60), GetParam());
  const Eigen::Isometry3d truth = motion(0.04, -0.03, 0.05, 0.01, 0.02, -0.02);
  const Eigen::Isometry3d prediction = motion(0.0, 0.0, -0.06, 0.0, 0.0, 0.0);
  const auto result = register_frame(corridor(truth, 31), {maps, {}}, {prediction},
                                     config_with(GetParam()), DepthNoise{});
  EXPECT_EQ(result.degenerate_directions, 1);
  const Eigen::Vector3d offset = result.T_world_sensor.translation() - truth.translation();
  EXPECT_NEAR(result.T_world_sensor.translation().z(), -0.06, 3e-3);
  EXPECT_LT(offset.head<2>().norm(), 3e-3);
  EXPECT_LT(angle_error_deg(result.T_world_sensor, truth), 0.02);
}

/// Outliers alone constrain the degenerate direction, wrongly.
TEST_P(RegisteredBy, CertainPredictionLimitsOutliers) {
  const BoxRoom room;
  const auto corridor = [&](const Eigen::Isometry3d& T, int density) {
    return faces_along(exact_features(room, T, density, 0.45), T, {0, 1});
  };
  const auto person = [](const Eigen::Isometry3d& T, double z) {
    FeatureCloud features;
    for (int i = 0; i < 100; ++i) {
      PlaneFeature& f = features.planes.emplace_back();
      const Eigen::Vector3d p(0.02 * (i % 10), 0.02 * static_cast<double>(i / 10), z);
      f.point = (T.inverse() * p).cast<float>();
      f.normal = (T.linear().transpose() * -Eigen::Vector3d::UnitZ()).cast<float>();
      f.sigma = 0.001F;
    }
    return features;
  };
  const auto merged = [](FeatureCloud a, const FeatureCloud& b) {
    a.planes.insert(a.planes.end(), b.planes.begin(), b.planes.end());
    return a;
  };
  const LocalMaps maps = map_of(merged(corridor(kOrigin, 60), person(kOrigin, 2.0)), GetParam());
  const Eigen::Isometry3d truth = motion(0.01, -0.01, 0.03, 0.0, 0.0, 0.0);
  const FeatureCloud frame = merged(corridor(truth, 31), person(truth, 2.06));
  const auto error_with = [&](const PosePrediction& prediction) {
    const auto result =
        register_frame(frame, {maps, {}}, prediction, config_with(GetParam()), DepthNoise{});
    return position_error(result.T_world_sensor, truth);
  };
  const Eigen::Isometry3d near = motion(0.01, -0.01, 0.031, 0.0, 0.0, 0.0);
  EXPECT_GT(error_with({near}), 0.03);
  EXPECT_LT(error_with({near, 1e-4, 1e-4}), 0.01);
}

TEST_P(RegisteredBy, InformativeDataOutweighPrediction) {
  const BoxRoom room;
  const LocalMaps maps = map_of(exact_features(room, kOrigin, 60), GetParam());
  const Eigen::Isometry3d truth = motion(0.05, -0.03, 0.04, 0.02, -0.03, 0.01);
  const auto result = register_frame(exact_features(room, truth, 31), {maps, {}},
                                     {kOrigin, 0.01, 0.01}, config_with(GetParam()), DepthNoise{});
  EXPECT_LT(position_error(result.T_world_sensor, truth), 2e-3);
  EXPECT_LT(angle_error_deg(result.T_world_sensor, truth), 0.05);
}

TEST(Registration, KeepsUnknownDirectionsOfAPredictionOfTheRotationAlone) {
  const BoxRoom room;
  const Eigen::Isometry3d truth = motion(0.0, 0.0, 0.03, 0.0, 0.0, 0.0);
  const FeatureCloud wall = faces_along(exact_features(room, kOrigin, 60), kOrigin, {2});
  FeatureCloud frame = faces_along(exact_features(room, truth, 31), truth, {2});
  // Normals that are inaccurate tell of a motion along the wall.
  for (std::size_t i = 0; i < frame.planes.size(); ++i)
    frame.planes[i].point.z() += 0.002F * static_cast<float>(i % 3);
  const PosePrediction prediction{.T_world_sensor = kOrigin, .rotation_sigma = 0.001};
  const auto result = register_frame(frame, {map_of(wall, Association::kSurface), {}}, prediction,
                                     config_with(Association::kSurface), DepthNoise{});
  EXPECT_GE(result.degenerate_directions, 2);
  EXPECT_LT(result.T_world_sensor.translation().head<2>().norm(), 1e-3);
  EXPECT_NEAR(result.T_world_sensor.translation().z(), 0.03, 0.01);
}

TEST(Registration, KeepsPredictionWithoutFeatures) {
  const LocalMaps maps = map_of(exact_features(BoxRoom{}, kOrigin), Association::kSurface);
  const Eigen::Isometry3d prediction = motion(1.0, 2.0, 3.0, 0.1, 0.2, 0.3);
  const auto result = register_frame({}, {maps, {}}, {prediction}, {}, DepthNoise{});
  EXPECT_EQ(result.degenerate_directions, 6);
  EXPECT_LT(position_error(result.T_world_sensor, prediction), 1e-12);
  EXPECT_EQ(result.geometric.planes.inliers, 0);
}

TEST(Registration, KeepsPredictionWithEmptyMaps) {
  const LocalMaps maps(0.2, 1000);
  const auto result =
      register_frame(exact_features(BoxRoom{}, kOrigin), {maps, {}}, {kOrigin}, {}, DepthNoise{});
  EXPECT_EQ(result.degenerate_directions, 6);
  EXPECT_TRUE(result.T_world_sensor.isApprox(kOrigin));
}

TEST(Registration, InformationGrowsWithFeatures) {
  const BoxRoom room;
  const LocalMaps maps = map_of(exact_features(room, kOrigin, 60), Association::kSurface);
  const auto information = [&](int density) {
    return register_frame(exact_features(room, kOrigin, density), {maps, {}}, {kOrigin}, {},
                          DepthNoise{})
        .information;
  };
  const Matrix6d few = information(15);
  const Matrix6d many = information(30);
  EXPECT_TRUE(few.isApprox(few.transpose()));
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(many - few).eigenvalues().minCoeff(), 0.0);
}

}  // namespace
}  // namespace mms
