// The optimum of our Gauss-Newton against that of Ceres with automatic differentiation.
#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <gtest/gtest.h>

#include <array>

#include "mms/localization/registration/registration.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using Vector3d = Eigen::Vector3d;

/// Pose as a parameter block of Ceres: angle-axis and translation, sensor to world.
using Parameters = std::array<double, 6>;

template <class T>
Eigen::Matrix<T, 3, 1> transformed(const T* pose, const Vector3d& point) {
  const Eigen::Matrix<T, 3, 1> p = point.cast<T>();
  Eigen::Matrix<T, 3, 1> result;
  ceres::AngleAxisRotatePoint(pose, p.data(), result.data());
  return result + Eigen::Map<const Eigen::Matrix<T, 3, 1>>(pose + 3);
}

struct PlaneCost {
  PlaneMatch match;
  double sigma;
  template <class T>
  bool operator()(const T* pose, T* residual) const {
    const Eigen::Matrix<T, 3, 1> offset = transformed(pose, match.point) - match.on_plane.cast<T>();
    residual[0] = match.normal.cast<T>().dot(offset) / sigma;
    return true;
  }
};

/// Eq. (3) with its numerator as a vector, so that it can be differentiated on the line.
struct EdgeCost {
  EdgeMatch match;
  double sigma;
  template <class T>
  bool operator()(const T* pose, T* residual) const {
    const Eigen::Matrix<T, 3, 1> offset = transformed(pose, match.point) - match.on_line.cast<T>();
    Eigen::Map<Eigen::Matrix<T, 3, 1>> result(residual);
    result = offset.cross(match.direction.cast<T>()) / T(sigma);
    return true;
  }
};

Parameters parameters_of(const Eigen::Isometry3d& T) {
  Parameters pose{};
  const Eigen::Matrix3d rotation = T.linear();
  ceres::RotationMatrixToAngleAxis(rotation.data(), pose.data());
  Eigen::Map<Vector3d>(pose.data() + 3) = T.translation();
  return pose;
}

Eigen::Isometry3d isometry_of(const Parameters& pose) {
  Eigen::Matrix3d rotation;
  ceres::AngleAxisToRotationMatrix(pose.data(), rotation.data());
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = rotation;
  T.translation() = Eigen::Map<const Vector3d>(pose.data() + 3);
  return T;
}

Eigen::Isometry3d minimized_by_ceres(const Matches& matches, const GeometricConfig& config,
                                     const Eigen::Isometry3d& start) {
  Parameters pose = parameters_of(start);
  ceres::Problem problem;
  for (const PlaneMatch& m : matches.planes) {
    const double sigma = std::hypot(m.sigma, config.map_sigma);
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PlaneCost, 1, 6>(new PlaneCost{m, sigma}),
        new ceres::CauchyLoss(config.robust_scale), pose.data());
  }
  for (const EdgeMatch& m : matches.edges) {
    const double sigma = std::hypot(m.sigma, config.map_sigma);
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<EdgeCost, 3, 6>(new EdgeCost{m, sigma}),
        new ceres::CauchyLoss(config.robust_scale), pose.data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 0.0;
  options.gradient_tolerance = 1e-10;
  options.parameter_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  EXPECT_TRUE(summary.IsSolutionUsable()) << summary.BriefReport();
  return isometry_of(pose);
}

struct Case {
  Association association;
  double robust_scale;  ///< 100 sigmas act like no robust loss
};

class AgainstCeres : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    std::mt19937 random(5);
    FeatureCloud map_features = exact_features(room_, Eigen::Isometry3d::Identity(), 40);
    testing::add_noise(map_features, 0.004, random);
    maps_.insert(map_features, Eigen::Isometry3d::Identity(), GetParam().association);
    frame_ = exact_features(room_, truth_, 17);
    testing::add_noise(frame_, 0.004, random);
    testing::add_outliers(frame_, 0.1, 0.3, random);
    config_.geometric.association = GetParam().association;
    config_.geometric.robust_scale = GetParam().robust_scale;
    config_.max_iterations = 200;
    config_.converged_translation = config_.converged_rotation = 1e-9;
  }

  Eigen::Isometry3d registered(const Eigen::Isometry3d& prediction) const {
    return register_frame(frame_, {maps_, {}}, {prediction}, config_, DepthNoise{}).T_world_sensor;
  }

  Matches matches_at(const Eigen::Isometry3d& T) const {
    const double gate = config_.geometric.gate * maps_.voxel_size();
    return associate(frame_, maps_, T, GetParam().association, gate);
  }

  testing::BoxRoom room_;
  Eigen::Isometry3d truth_ = testing::motion(0.03, -0.02, 0.04, 0.01, -0.02, 0.015);
  LocalMaps maps_{0.2, 100000};
  FeatureCloud frame_;
  RegistrationConfig config_;
};

INSTANTIATE_TEST_SUITE_P(Registration, AgainstCeres,
                         ::testing::Values(Case{Association::kSurface, 2.0},
                                           Case{Association::kPaper, 2.0},
                                           Case{Association::kSurface, 100.0},
                                           Case{Association::kPaper, 100.0}));

TEST_P(AgainstCeres, FindsSamePose) {
  // Registration from its own result keeps the matches.
  const Eigen::Isometry3d converged = registered(registered(truth_));
  const Eigen::Isometry3d ours = registered(converged);
  const Matches matches = matches_at(converged);
  ASSERT_GT(matches.planes.size(), 500U);
  ASSERT_GT(matches.edges.size(), 300U);
  const Eigen::Isometry3d start =
      converged * testing::motion(0.01, 0.02, -0.01, 0.005, 0.01, 0.005);
  const Eigen::Isometry3d theirs = minimized_by_ceres(matches, config_.geometric, start);
  EXPECT_LT(testing::position_error(ours, theirs), 1e-6);
  EXPECT_LT(testing::angle_error_deg(ours, theirs) * M_PI / 180.0, 1e-6);
}

TEST_P(AgainstCeres, GradientVanishesAtOptimum) {
  const Matches matches = matches_at(truth_);
  const Eigen::Isometry3d optimum = minimized_by_ceres(matches, config_.geometric, truth_);
  const auto equations = geometric_equations(matches, optimum, config_.geometric);
  NormalEquations sum = equations.planes;
  sum += equations.edges;
  const Vector6d step = sum.information.ldlt().solve(sum.gradient);
  EXPECT_LT(step.norm(), 1e-8);
}

}  // namespace
}  // namespace mms
