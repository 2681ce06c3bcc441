// Optimization of a pose graph, and the correction over time that follows from it.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "mms/core/random_stream.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/global_map/graph/loop_confirmation.hpp"
#include "mms/global_map/graph/loop_graph.hpp"
#include "mms/global_map/graph/odometry_noise.hpp"
#include "mms/global_map/graph/pose_graph.hpp"
#include "mms/global_map/pose_correction.hpp"

namespace mms {
namespace {

using Isometry = Eigen::Isometry3d;

Matrix6d information(double translation_sigma, double rotation_sigma) {
  Vector6d diagonal;
  diagonal.head<3>().setConstant(1.0 / (translation_sigma * translation_sigma));
  diagonal.tail<3>().setConstant(1.0 / (rotation_sigma * rotation_sigma));
  return diagonal.asDiagonal();
}

/// A circle of 40 steps; the last node is where the first one is.
std::vector<Isometry> circle() {
  std::vector<Isometry> poses = {Isometry::Identity()};
  Vector6d step = Vector6d::Zero();
  step(0) = 0.5;
  step(5) = 2.0 * std::numbers::pi / 40.0;
  for (int i = 0; i < 40; ++i) poses.push_back(poses.back() * se3::exp(step));
  return poses;
}

Vector6d drift(RandomStream& random) {
  Vector6d noise;
  for (int i = 0; i < 6; ++i) noise(i) = random.between(-0.01F, 0.01F);
  noise(5) += 0.01;  // systematic, about the vertical axis
  return noise;
}

PoseGraph drifted_circle() {
  const std::vector<Isometry> truth = circle();
  RandomStream random(1);
  PoseGraph graph;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    graph.add_node(truth[i - 1].inverse() * truth[i] * se3::exp(drift(random)),
                   information(0.01, 0.015));
  }
  return graph;
}

double largest_error(const PoseGraph& graph) {
  const std::vector<Isometry> truth = circle();
  double largest = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double error = (graph.poses()[i].translation() - truth[i].translation()).norm();
    largest = std::max(largest, error);
  }
  return largest;
}

TEST(PoseGraph, ALoopDistributesTheDriftOfACircle) {
  PoseGraph graph = drifted_circle();
  const double before = largest_error(graph);
  ASSERT_GT(before, 0.3);
  graph.add_loop({0, 40, Isometry::Identity(), information(0.01, 0.005)});
  EXPECT_TRUE(graph.solve().empty());
  EXPECT_LT(largest_error(graph), 0.25 * before);
  EXPECT_LT(graph.poses().back().translation().norm(), 0.05);
  EXPECT_EQ(graph.poses().front().matrix(), Isometry::Identity().matrix());
}

TEST(PoseGraph, EqualEdgesGiveEqualPoses) {
  const auto solved = [] {
    PoseGraph graph = drifted_circle();
    graph.add_loop({0, 40, Isometry::Identity(), information(0.01, 0.005)});
    graph.solve();
    return graph.poses().back().matrix().eval();
  };
  EXPECT_EQ(solved(), solved());
}

TEST(PoseGraph, RemovesALoopThatContradictsTheOthers) {
  PoseGraph graph = drifted_circle();
  const std::vector<Isometry> truth = circle();
  for (std::size_t i = 0; i < 3; ++i) {
    graph.add_loop({i, 38 + i, truth[i].inverse() * truth[38 + i], information(0.01, 0.005)});
  }
  Isometry wrong = truth[5].inverse() * truth[30];
  wrong.translation().x() += 3.0;
  graph.add_loop({5, 30, wrong, information(0.01, 0.005)});
  const std::vector<PoseEdge> removed = graph.solve();
  ASSERT_EQ(removed.size(), 1U);
  EXPECT_EQ(removed[0].a, 5U);
  EXPECT_EQ(graph.loops().size(), 3U);
  EXPECT_LT(largest_error(graph), 0.2);
}

TEST(PoseGraph, DirectionsWithoutInformationStayFree) {
  PoseGraph graph;
  Isometry step = Isometry::Identity();
  step.translation().x() = 1.0;
  graph.add_node(step, information(0.1, 0.01));
  Isometry measured = step;
  measured.translation() += Eigen::Vector3d(0.05, 0.05, 0.05);
  Matrix6d only_x = Matrix6d::Zero();
  only_x(0, 0) = 1e8;
  graph.add_loop({0, 1, measured, only_x});
  graph.solve();
  EXPECT_NEAR(graph.poses()[1].translation().x(), 1.05, 1e-4);
  EXPECT_NEAR(graph.poses()[1].translation().y(), 0.0, 1e-6);
}

/// Pose of the second of two nodes relative to the first one, for a loop that ties its rotation to
/// its position.
Isometry relative_pose(double heading) {
  const auto turn = [](double degrees) {
    return Isometry(
        Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()));
  };
  const Isometry measured = Isometry(Eigen::Translation3d(0.5, 0.0, 0.0)) * turn(-2.0);
  const Isometry by_odometry = Isometry(Eigen::Translation3d(0.5, 0.04, 0.0)) * turn(-2.0);
  Matrix6d tied = information(0.01, 0.003);
  tied(1, 5) = tied(5, 1) = 0.9 * std::sqrt(tied(1, 1) * tied(5, 5));
  PoseGraph graph(turn(heading));
  graph.add_node(by_odometry, information(0.01, 0.003));
  graph.add_loop({0, 1, measured, tied});
  EXPECT_TRUE(graph.solve().empty());
  return graph.poses()[0].inverse() * graph.poses()[1];
}

TEST(PoseGraph, SolutionIsTheSameForAnyHeading) {
  const Isometry expected = relative_pose(0.0);
  for (int heading = -179; heading < 180; heading += 2) {
    EXPECT_TRUE(relative_pose(heading).isApprox(expected, 1e-4)) << heading;
  }
}

TEST(PoseGraph, ChainCovarianceIsThatOfManySampledChains) {
  Isometry step = Isometry::Identity();
  step.linear() = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  step.translation().x() = 0.5;
  PoseGraph graph;
  Isometry end = Isometry::Identity();
  for (int i = 0; i < 10; ++i) {
    graph.add_node(step, information(0.01, 0.02));
    end = end * step;
  }
  const Matrix6d covariance = graph.chain_covariance(0, 10);
  RandomStream random(2);
  Matrix6d sampled = Matrix6d::Zero();
  constexpr int kSamples = 20000;
  for (int s = 0; s < kSamples; ++s) {
    Isometry pose = Isometry::Identity();
    for (int i = 0; i < 10; ++i) {
      Vector6d noise;
      for (int k = 0; k < 6; ++k) {
        float sum = -6.0F;  // of twelve uniform numbers: nearly normal, variance 1
        for (int n = 0; n < 12; ++n) sum += random.uniform();
        noise(k) = sum * (k < 3 ? 0.01F : 0.02F);
      }
      pose = pose * step * se3::exp(noise);
    }
    const Vector6d error = se3::log(end.inverse() * pose);
    sampled += error * error.transpose() / kSamples;
  }
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(std::sqrt(covariance(k, k)), std::sqrt(sampled(k, k)),
                0.05 * std::sqrt(sampled(k, k)));
  }
}

TEST(PoseGraph, ChainCovarianceIsThatOfItsOwnEdgesAlone) {
  Vector6d step;
  step << 0.3, 0.1, -0.2, 0.02, 0.3, -0.1;
  PoseGraph whole;
  PoseGraph part;
  for (int i = 0; i < 2000; ++i) {
    const Matrix6d noise = i < 1990 ? information(3.0, 1.0) : information(0.01, 0.002);
    whole.add_node(se3::exp(step), noise, i == 5);
    if (i >= 1990) part.add_node(se3::exp(step), noise);
  }
  const Matrix6d expected = part.chain_covariance(0, 10);
  EXPECT_TRUE(whole.chain_covariance(1990, 2000).isApprox(expected, 1e-3));
  EXPECT_TRUE(whole.chain_covariance(700, 700).isZero());
}

TEST(PoseGraph, LongChainsTakeNoMoreTimeThanShortOnes) {
  Isometry step = Isometry::Identity();
  step.translation().x() = 0.25;
  PoseGraph graph;
  for (int i = 0; i < 10000; ++i) graph.add_node(step, information(0.01, 0.002));
  const auto start = std::chrono::steady_clock::now();
  double sum = 0.0;
  for (std::size_t first = 0; first < 1000; ++first) {
    sum += graph.chain_covariance(first, 10000)(0, 0);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_GT(sum, 0.0);
  EXPECT_LT(seconds.count(), 2.0) << "a keyframe asks for several; by edges it takes 10 s or more";
}

TEST(OdometryNoise, GrowsWithTheMotionAndWithoutLocalization) {
  Isometry step = Isometry::Identity();
  step.translation().x() = 0.25;
  Isometry longer = step;
  longer.translation().x() = 2.5;
  const double at_step = odometry_information(step, false)(0, 0);
  EXPECT_GT(at_step, odometry_information(longer, false)(0, 0));
  EXPECT_GT(odometry_information(longer, false)(0, 0), odometry_information(step, true)(0, 0));
  EXPECT_GT(odometry_information(Isometry::Identity(), false).diagonal().minCoeff(), 0.0);
}

Transform<Global, World> shifted(double x) {
  Isometry pose = Isometry::Identity();
  pose.translation().x() = x;
  return Transform<Global, World>(pose);
}

TEST(PoseCorrection, IsInterpolatedBetweenKeyframes) {
  PoseCorrection correction;
  EXPECT_TRUE(correction.empty());
  EXPECT_EQ(correction.at(Timestamp(5)).translation().x(), 0.0);
  correction.add(Timestamp(100), shifted(0.0));
  correction.add(Timestamp(200), shifted(1.0));
  EXPECT_EQ(correction.at(Timestamp(50)).translation().x(), 0.0);
  EXPECT_EQ(correction.at(Timestamp(100)).translation().x(), 0.0);
  EXPECT_NEAR(correction.at(Timestamp(125)).translation().x(), 0.25, 1e-12);
  EXPECT_NEAR(correction.at(Timestamp(200)).translation().x(), 1.0, 1e-12);
  EXPECT_EQ(correction.at(Timestamp(900)).translation().x(), 1.0);
}

/// Standard deviation of a keyframe relative to that of a lap of 62 m before [m].
double sigma_after_a_lap(bool has_loop) {
  constexpr std::size_t kLap = 248;
  constexpr std::size_t kEnd = 2 * kLap - 100;
  LoopGraph graph(20.0);
  Isometry pose = Isometry::Identity();
  for (std::size_t i = 0; i < kEnd; ++i) {
    KeyframeRecord record;
    record.T_world_sensor = Transform<World, Sensor>(pose);
    graph.add_node(record);
    if (has_loop && i + 12 == kEnd) {
      Loop loop;
      loop.candidate = i - kLap;
      loop.query = i;
      loop.outcome = LoopOutcome::kAccepted;
      loop.information = information(0.01, 0.002);
      graph.add_check(loop);
      graph.add_edges({loop});
    }
    Isometry step(Eigen::Translation3d(0.25, 0.0, 0.0));
    if (i % 62 >= 56) {
      step.rotate(Eigen::AngleAxisd(std::numbers::pi / 12, Eigen::Vector3d::UnitZ()));
    }
    pose = pose * step;
  }
  const auto covariance = graph.relative_covariance(kEnd - 1 - kLap, kEnd - 1);
  return std::sqrt(covariance->topLeftCorner<3, 3>().diagonal().maxCoeff());
}

TEST(LoopGraph, AClosedLoopTellsWhereTheOdometryIs) {
  EXPECT_GT(sigma_after_a_lap(false), 0.15);
  EXPECT_LT(sigma_after_a_lap(true), 0.05);
}

/// Loops that are accepted with each keyframe of a second session, which agree.
std::vector<std::size_t> accepted_loops(const std::vector<int>& inliers) {
  constexpr int kMinInliers = 20;
  constexpr std::size_t kFirst = 5;  // keyframes of the first session
  LoopGraph graph(20.0);
  LoopConfirmation confirmation;
  std::vector<std::size_t> accepted;
  for (std::size_t i = 0; i < kFirst + inliers.size(); ++i) {
    const std::size_t step = i < kFirst ? i : i - kFirst;
    KeyframeRecord record;
    record.session = i < kFirst ? 0U : 1U;
    record.T_world_sensor = Transform<World, Sensor>(
        Isometry(Eigen::Translation3d(0.25 * static_cast<double>(step), 0.0, 0.0)));
    graph.add_node(record);
    if (i < kFirst) continue;
    Loop loop;
    loop.candidate = step;
    loop.query = i;
    loop.outcome = LoopOutcome::kAccepted;
    loop.information = information(0.01, 0.002);
    loop.inliers = inliers[step];
    EXPECT_TRUE(confirmation.is_likely(graph, loop, kMinInliers));
    graph.add_check(loop);
    accepted.push_back(confirmation.confirm(graph, kMinInliers).size());
  }
  return accepted;
}

TEST(LoopConfirmation, SessionsAreJoinedByManyKeypointsTogether) {
  using Counts = std::vector<std::size_t>;
  EXPECT_EQ(accepted_loops({45, 45, 25}), (Counts{0, 2, 1}));
  EXPECT_EQ(accepted_loops({25, 26, 27}), (Counts{0, 0, 0})) << "78 pairs are too few";
  EXPECT_EQ(accepted_loops({25, 25, 30}), (Counts{0, 0, 3}));
}

TEST(LoopGraph, SessionsAreRelatedByAnotherOne) {
  for (const bool has_second : {false, true}) {
    LoopGraph graph(20.0);
    for (std::size_t i = 0; i < 15; ++i) {
      KeyframeRecord record;
      record.session = static_cast<std::uint32_t>(i / 5);
      record.T_world_sensor = Transform<World, Sensor>(
          Isometry(Eigen::Translation3d(0.25 * static_cast<double>(i % 5), 0.0, 0.0)));
      graph.add_node(record);
      if (i % 5 != 0 || i == 0 || (i == 10 && !has_second)) continue;
      Loop loop;
      loop.candidate = i - 5;
      loop.query = i;
      loop.outcome = LoopOutcome::kAccepted;
      loop.information = information(0.01, 0.002);
      graph.add_check(loop);
      graph.add_edges({loop});
    }
    const auto covariance = graph.relative_covariance(1, 13);
    ASSERT_EQ(covariance.has_value(), has_second);
    if (!covariance) continue;
    EXPECT_LT(std::sqrt(covariance->diagonal().maxCoeff()), 0.1);
    EXPECT_GT(covariance->diagonal().minCoeff(), 0.0);
  }
}

/// Session 3 is joined to session 1, and then to session 2; none of them to the map.
TEST(LoopGraph, JoinedSessionsAreInTheFrameOfTheEarliestOne) {
  LoopGraph graph(20.0);
  for (std::uint32_t session = 0; session < 4; ++session) {
    KeyframeRecord record;
    record.session = session;
    record.T_world_sensor = Transform<World, Sensor>(
        Isometry(Eigen::Translation3d(10.0 * static_cast<double>(session), 0.0, 0.0)));
    graph.add_node(record);
  }
  for (const std::size_t candidate : {1U, 2U}) {
    Loop loop;
    loop.candidate = candidate;
    loop.query = 3;
    loop.outcome = LoopOutcome::kAccepted;
    loop.information = information(0.01, 0.002);
    graph.add_check(loop);
    graph.add_edges({loop});
    EXPECT_NEAR(graph.poses()[1].translation().x(), 10.0, 1e-9);
  }
  for (const std::size_t node : {2U, 3U}) {
    EXPECT_NEAR(graph.poses()[node].translation().x(), 10.0, 1e-9);
  }
}

/// 24 days, each with a loop to every day before but the first one, which a last day joins.
TEST(LoopGraph, SessionsOfManyDaysAreSearchedInShortTime) {
  constexpr std::uint32_t kDays = 25;
  LoopGraph graph(20.0);
  const auto join_to = [&](std::uint32_t other) {
    Loop loop;
    loop.candidate = 2 * std::size_t{other} + 1;
    loop.query = graph.size() - 1;
    loop.outcome = LoopOutcome::kAccepted;
    loop.information = information(0.01, 0.002);
    graph.add_check(loop);
    graph.add_edges({loop});
  };
  const auto start = std::chrono::steady_clock::now();
  for (std::uint32_t day = 0; day <= kDays; ++day) {
    for (const double x : {0.0, 0.25}) {
      KeyframeRecord record;
      record.session = day;
      record.T_world_sensor = Transform<World, Sensor>(Isometry(Eigen::Translation3d(x, 0.0, 0.0)));
      graph.add_node(record);
    }
    if (day == kDays) join_to(0);
    for (std::uint32_t other = 1; other < day; ++other) join_to(other);
    if (day + 1 != kDays) continue;
    EXPECT_FALSE(graph.is_joined(day));
    EXPECT_FALSE(graph.relative_covariance(0, graph.size() - 1));
  }
  EXPECT_TRUE(graph.share_frame(0, 1));
  EXPECT_FALSE(graph.relative_covariance(0, 2 * std::size_t{kDays} - 1)) << "only by a later day";
  EXPECT_TRUE(graph.relative_covariance(2, graph.size() - 1));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 2.0);
}

}  // namespace
}  // namespace mms
