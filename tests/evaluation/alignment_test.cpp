#include "mms/evaluation/trajectory/alignment.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/evaluation/trajectories.hpp"

namespace mms {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points transformed(const Points& points, const Eigen::Isometry3d& transform) {
  Points result;
  for (const Eigen::Vector3d& point : points) result.push_back(transform * point);
  return result;
}

class AlignmentOfSeed : public testing::TestWithParam<unsigned> {};

TEST_P(AlignmentOfSeed, RecoversTransform) {
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> uniform(-5.0, 5.0);
  Points source;
  for (int i = 0; i < 20; ++i)
    source.emplace_back(uniform(random), uniform(random), uniform(random));
  const Eigen::Isometry3d truth = test::random_isometry(random, 10.0, 1.8);
  const Eigen::Isometry3d found = align_points(source, transformed(source, truth));
  EXPECT_TRUE(found.isApprox(truth, 1e-9)) << found.matrix() << "\n\n" << truth.matrix();
}

TEST_P(AlignmentOfSeed, IsLocalOptimumWithNoise) {
  std::mt19937 random(GetParam());
  std::normal_distribution<double> normal;
  Points source;
  Points target;
  for (int i = 0; i < 30; ++i) {
    source.emplace_back(normal(random), normal(random), normal(random));
    target.push_back(source.back() + 0.1 * Eigen::Vector3d(normal(random), normal(random), 0.0));
  }
  const auto cost = [&](const Eigen::Isometry3d& transform) {
    double sum = 0.0;
    for (std::size_t i = 0; i < source.size(); ++i) {
      sum += (target[i] - transform * source[i]).squaredNorm();
    }
    return sum;
  };
  const Eigen::Isometry3d best = align_points(source, target);
  for (int i = 0; i < 20; ++i) {
    EXPECT_LE(cost(best), cost(best * test::random_isometry(random, 0.01, 0.01)));
  }
}

TEST_P(AlignmentOfSeed, AlignsPosesOfStaticSensor) {
  std::mt19937 random(GetParam());
  const Eigen::Isometry3d truth = test::random_isometry(random, 10.0, 1.8);
  std::vector<Eigen::Isometry3d> source;
  std::vector<Eigen::Isometry3d> target;
  for (int i = 0; i < 10; ++i) {
    source.push_back(test::random_isometry(random, 0.0, 0.5));
    target.push_back(truth * source.back());
  }
  const Eigen::Isometry3d found = align_poses(source, target);
  EXPECT_TRUE(found.isApprox(truth, 1e-9)) << found.matrix() << "\n\n" << truth.matrix();
}

INSTANTIATE_TEST_SUITE_P(Seeds, AlignmentOfSeed, testing::Range(0U, 20U));

TEST(Alignment, IsRotationForMirroredPlanarPoints) {
  const Points flat = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {3, 1, 0}};
  Points mirrored = flat;
  for (Eigen::Vector3d& point : mirrored) point.x() = -point.x();
  EXPECT_NEAR(align_points(flat, mirrored).linear().determinant(), 1.0, 1e-12);
}

TEST(Alignment, CoincidentPointsGiveTranslation) {
  const Points source(4, Eigen::Vector3d(1, 2, 3));
  const Points target(4, Eigen::Vector3d(5, 5, 5));
  EXPECT_TRUE((align_points(source, target) * source[0]).isApprox(target[0], 1e-12));
}

TEST(Alignment, NeedsThreePairs) {
  const Points two(2, Eigen::Vector3d::Zero());
  EXPECT_THROW(align_points(two, two), DataError);
  EXPECT_THROW(align_points(Points(3, Eigen::Vector3d::Zero()), two), DataError);
}

TEST(Alignment, PosesNeedPairs) {
  const std::vector<Eigen::Isometry3d> one(1, Eigen::Isometry3d::Identity());
  EXPECT_THROW(align_poses({}, {}), DataError);
  EXPECT_THROW(align_poses(one, {}), DataError);
  EXPECT_TRUE(align_poses(one, one).isApprox(one.front()));
}

}  // namespace
}  // namespace mms
