// The place in the map that a user tells, as by the initial pose of ROS.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "mms/geometry/se3.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "tests/pipeline/aisle_views.hpp"

namespace mms {
namespace {

using Place = Transform<Global, Sensor>;

constexpr int kEnd = 60;  // frames of the aisle, 10 a second

std::unique_ptr<SlamSystem> make_system() {
  SystemConfig config;
  return std::make_unique<SlamSystem>(config, std::make_unique<MaskSegmenter>());
}

/// Results of the frames from one up to another.
/// @param told  with the frame `told_at`
std::vector<FrameResult> drive(SlamSystem& system, int first, int end, int told_at = -1,
                               const Place& told = {}) {
  SceneConfig config = aisle(1);
  config.hz = 10.0;
  SimulatedScene scene(config);
  std::vector<FrameResult> results;
  for (int i = first; i < end; ++i) {
    Frame frame = scene.render(i).frame;
    if (i == told_at) frame.expected_place = told;
    results.push_back(system.process(frame));
  }
  return results;
}

/// A first run through the aisle; its world is the frame of the map.
struct EarlierRun {
  std::unique_ptr<SlamSystem> system = make_system();
  std::vector<FrameResult> results = drive(*system, 0, kEnd);

  Place place(int frame) const {
    return Place(results[static_cast<std::size_t>(frame)].odometry.T_world_sensor.isometry());
  }

  std::unique_ptr<SlamSystem> localizer() const {
    auto later = make_system();
    const GlobalMap& map = system->global_map();
    later->restore({map.records(), map.poses(), map.loops()}, MapUse::kLocalizeOnly);
    return later;
  }
};

const EarlierRun& earlier_run() {
  static const EarlierRun kRun;
  return kRun;
}

/// Whether the last frame is known to be at a place, to 5 cm.
bool is_at(const FrameResult& result, const Place& place) {
  if (!result.correction.T_global_world) return false;
  const Eigen::Vector3d position =
      (*result.correction.T_global_world * result.odometry.T_world_sensor).translation();
  return (position - place.translation()).norm() < 0.05;
}

/// Distances of the candidates of the first keyframe of a run from a place [m], in order.
std::vector<double> distances_of_candidates(const GlobalMap& map, std::size_t keyframe,
                                            const Place& place) {
  std::vector<double> distances;
  for (const Loop& loop : map.loops()) {
    if (loop.query != keyframe) continue;
    distances.push_back((map.poses()[loop.candidate].translation() - place.translation()).norm());
  }
  return distances;
}

TEST(ExpectedPlace, KeyframesAroundItAreComparedFirst) {
  const int first = 25;
  const Place place = earlier_run().place(first);
  // As a click on a map: 0.5 m to the side, at another height, turned by 15 degrees.
  const Eigen::Isometry3d error(Eigen::Translation3d(0.5, -1.0, 0.2) *
                                Eigen::AngleAxisd(0.26, Eigen::Vector3d::UnitY()));
  const auto system = earlier_run().localizer();
  const std::size_t keyframe = system->global_map().records().size();
  const auto results = drive(*system, first, 45, first, Place(place.isometry() * error));
  const std::vector<double> distances =
      distances_of_candidates(system->global_map(), keyframe, place);
  ASSERT_FALSE(distances.empty());
  EXPECT_LT(distances.front(), 0.7);
  EXPECT_TRUE(results.front().expected_place);
  EXPECT_TRUE(is_at(results.back(), earlier_run().place(44)));
  EXPECT_FALSE(results.back().expected_place) << "the place is known";
}

TEST(ExpectedPlace, WrongOneIsNotTaken) {
  const int first = 20;
  const Place wrong = earlier_run().place(first + 30);
  const auto system = earlier_run().localizer();
  const std::size_t keyframe = system->global_map().records().size();
  const auto results = drive(*system, first, 40, first, wrong);
  const std::vector<double> distances =
      distances_of_candidates(system->global_map(), keyframe, wrong);
  ASSERT_FALSE(distances.empty());
  EXPECT_LT(distances.front(), 0.5) << "it was looked at";
  EXPECT_TRUE(is_at(results.back(), earlier_run().place(39)));
}

TEST(ExpectedPlace, BeginsASessionWhereAnotherPlaceSeemedKnown) {
  const int told_at = 30;
  const auto system = make_system();
  const auto results = drive(*system, 0, kEnd, told_at, earlier_run().place(told_at));
  for (int i = 0; i < kEnd; ++i) {
    EXPECT_EQ(results[static_cast<std::size_t>(i)].session, i < told_at ? 0U : 1U);
  }
  const FrameResult& told = results[static_cast<std::size_t>(told_at)];
  EXPECT_EQ(told.odometry.status, Status::kInitialized);
  EXPECT_FALSE(told.correction.T_global_world);
  ASSERT_TRUE(told.expected_place);
  EXPECT_TRUE(told.expected_place->isometry().isApprox(earlier_run().place(told_at).isometry()));
  EXPECT_TRUE(is_at(results.back(), earlier_run().place(kEnd - 1)));
}

TEST(ExpectedPlace, IsForgottenAfterSeconds) {
  const auto system = earlier_run().localizer();
  // Another aisle: nothing there is in the map.
  SceneConfig config = aisle(2);
  config.hz = 2.0;
  SimulatedScene scene(config);
  std::vector<FrameResult> results;
  for (int i = 0; i < 24; ++i) {
    Frame frame = scene.render(i).frame;
    if (i == 0) frame.expected_place = earlier_run().place(25);
    results.push_back(system->process(frame));
  }
  EXPECT_TRUE(results[20].expected_place);
  EXPECT_FALSE(results[21].expected_place) << "after 10.5 s";
  EXPECT_FALSE(results.back().correction.T_global_world) << "it is another aisle";
}

}  // namespace
}  // namespace mms
