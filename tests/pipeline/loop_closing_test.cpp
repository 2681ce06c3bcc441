// Loop closure with simulated frames: the sensor comes back to places that it has seen, with poses
// that drifted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "mms/geometry/se3.hpp"
#include "mms/global_map/global_map.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/pipeline/perception.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "mms/simulation/simulated_scene.hpp"
#include "tests/pipeline/aisle_views.hpp"

namespace mms {
namespace {

GlobalMap make_map(double max_dissimilarity = LoopConfig{}.max_dissimilarity) {
  GlobalMapConfig config;
  config.min_path = 2.0;
  config.loops.max_dissimilarity = max_dissimilarity;
  const SystemConfig system;
  return GlobalMap(config, system.features, system.odometry.registration);
}

/// The path forward and backward; the poses of the way back drift.
struct Visit {
  GlobalMap map = make_map();
  std::vector<Eigen::Isometry3d> truth{};  // by keyframe
  std::vector<Eigen::Isometry3d> drifted{};

  void add(GlobalKeyframe keyframe, const Eigen::Isometry3d& drift) {
    truth.push_back(keyframe.T_world_sensor.isometry());
    const Eigen::Isometry3d pose = drift * truth.back();
    drifted.push_back(pose);
    keyframe.T_world_sensor = Transform<World, Sensor>(pose);
    keyframe.cloud.stamp = Timestamp(static_cast<std::int64_t>(truth.size()) * 1'000'000'000);
    map.add(keyframe);
  }

  double largest_error(const std::vector<Eigen::Isometry3d>& poses) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      largest = std::max(largest, (poses[i].translation() - truth[i].translation()).norm());
    }
    return largest;
  }
};

/// @param drift  of the second visit per step [m] to the right
Visit there_and_back(double drift) {
  Visit visit;
  for (int i = 0; i < kSteps; ++i) {
    visit.add(views()[static_cast<std::size_t>(i)], Eigen::Isometry3d::Identity());
  }
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  for (int i = kSteps - 1; i >= 0; --i) {
    offset.translation().x() += drift;
    visit.add(views()[static_cast<std::size_t>(i)], offset);
  }
  visit.map.finish();
  return visit;
}

/// Largest distance of the poses of both visits of a place, where loops can close [m].
double largest_gap(const std::vector<Eigen::Isometry3d>& poses) {
  double largest = 0.0;
  for (std::size_t i = 0; i + 4 < kSteps; ++i) {
    const Eigen::Vector3d back = poses[2 * kSteps - 1 - i].translation();
    largest = std::max(largest, (back - poses[i].translation()).norm());
  }
  return largest;
}

int accepted(const GlobalMap& map) {
  return static_cast<int>(std::count_if(map.loops().begin(), map.loops().end(), [](const Loop& l) {
    return l.outcome == LoopOutcome::kAccepted;
  }));
}

TEST(LoopClosing, CorrectsDriftOfASecondVisit) {
  const Visit visit = there_and_back(0.005);
  ASSERT_GT(largest_gap(visit.drifted), 0.09);
  EXPECT_GE(accepted(visit.map), kSteps / 2);
  EXPECT_LT(largest_gap(visit.map.poses()), 0.25 * largest_gap(visit.drifted));
  EXPECT_LT(visit.largest_error(visit.map.poses()), 0.5 * visit.largest_error(visit.drifted));
  EXPECT_FALSE(visit.map.correction().empty());
}

TEST(LoopClosing, EveryAcceptedLoopIsRight) {
  const Visit visit = there_and_back(0.005);
  for (const Loop& loop : visit.map.loops()) {
    if (loop.outcome != LoopOutcome::kAccepted) continue;
    const Eigen::Isometry3d truth = visit.truth[loop.candidate].inverse() * visit.truth[loop.query];
    const Eigen::Isometry3d error = truth.inverse() * loop.T_candidate_query;
    EXPECT_LT(error.translation().norm(), 0.05);
    EXPECT_LT(se3::angle(error), 0.01);
  }
}

TEST(LoopClosing, FindsAPlaceByItsLooksAfterBeingLost) {
  Visit visit;
  for (int i = 0; i < kSteps; ++i) {
    visit.add(views()[static_cast<std::size_t>(i)], Eigen::Isometry3d::Identity());
  }
  // Carried back in the dark: the pose is two meters off.
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  offset.translation() = Eigen::Vector3d(0.5, 0.0, 2.0);
  for (int i = 2; i < 8; ++i) {
    GlobalKeyframe keyframe = views()[static_cast<std::size_t>(i)];
    keyframe.after_lost = i == 2;
    visit.add(keyframe, offset);
  }
  ASSERT_GT(visit.largest_error(visit.drifted), 2.0);
  EXPECT_GE(accepted(visit.map), 2);
  EXPECT_LT(visit.largest_error(visit.map.poses()), 0.03);
}

TEST(LoopClosing, ASessionOfTheRunHasAWorldOfItsOwnUntilLoopsJoinIt) {
  Visit visit;
  for (const GlobalKeyframe& view : views()) visit.add(view, Eigen::Isometry3d::Identity());
  EXPECT_EQ(visit.map.session_of_run(0), 0U);
  EXPECT_FALSE(visit.map.session_of_run(3));
  EXPECT_TRUE(visit.map.last_correction());
  const Eigen::Isometry3d elsewhere(Eigen::Translation3d(40.0, 0.0, 7.0));
  const auto again = [&](int i) {
    GlobalKeyframe view = views()[static_cast<std::size_t>(i)];
    view.session = 3;  // sessions 1 and 2 had no keyframe
    visit.add(view, elsewhere);
  };
  again(2);
  EXPECT_EQ(visit.map.session_of_run(3), 1U);
  EXPECT_FALSE(visit.map.session_of_run(2));
  EXPECT_FALSE(visit.map.share_frame(0, 1));
  EXPECT_FALSE(visit.map.last_correction()) << "one view is not enough";
  for (int i = 3; i < 8; ++i) again(i);
  EXPECT_TRUE(visit.map.share_frame(0, 1));
  ASSERT_TRUE(visit.map.last_correction());
  const Eigen::Isometry3d error = visit.map.last_correction()->isometry() * elsewhere;
  EXPECT_LT(error.translation().norm(), 0.03);
  EXPECT_EQ(visit.map.earlier_sessions(), 0U);
}

TEST(LoopClosing, OtherPlacesThatLookAlikeCloseNoLoop) {
  Visit visit;
  for (const GlobalKeyframe& view : views()) visit.add(view, Eigen::Isometry3d::Identity());
  // Another aisle of the same racks: by odometry, it may be anywhere.
  bool after_lost = true;
  for (GlobalKeyframe view : views_of(2)) {
    view.after_lost = std::exchange(after_lost, false);
    visit.add(view, Eigen::Isometry3d::Identity());
  }
  EXPECT_EQ(accepted(visit.map), 0);
  EXPECT_TRUE(visit.map.correction().empty());
}

TEST(LoopClosing, WithoutLeastPathAKeyframeIsNoCandidateOfItself) {
  GlobalMapConfig config;
  config.min_path = 0.0;
  const SystemConfig system;
  GlobalMap map(config, system.features, system.odometry.registration);
  for (const GlobalKeyframe& view : views()) map.add(view);
  EXPECT_FALSE(map.loops().empty());
  for (const Loop& loop : map.loops()) EXPECT_LT(loop.candidate, loop.query);
}

/// Five laps; the way back from the end to the start is not seen.
TEST(LoopClosing, OfManyVisitsTheViewsOfThreeAreKept) {
  Visit visit;
  std::vector<int> views_of_lap;
  for (int lap = 0; lap < 5; ++lap) {
    for (int i = 0; i < kSteps; ++i) {
      visit.add(views()[static_cast<std::size_t>(i)], Eigen::Isometry3d::Identity());
    }
    const auto first = visit.map.records().begin() + lap * kSteps;
    views_of_lap.push_back(static_cast<int>(std::count_if(
        first, first + kSteps, [](const KeyframeRecord& r) { return !r.is_pose_only(); })));
  }
  for (int lap = 0; lap < 3; ++lap) EXPECT_EQ(views_of_lap[static_cast<std::size_t>(lap)], kSteps);
  EXPECT_LE(views_of_lap[3], kSteps / 3);
  EXPECT_LE(views_of_lap[4], kSteps / 3);
  EXPECT_LT(visit.largest_error(visit.map.poses()), 0.03);
}

TEST(LoopClosing, EqualKeyframesGiveEqualPoses) {
  const Visit a = there_and_back(0.005);
  const Visit b = there_and_back(0.005);
  ASSERT_EQ(a.map.poses().size(), b.map.poses().size());
  for (std::size_t i = 0; i < a.map.poses().size(); ++i) {
    EXPECT_EQ(a.map.poses()[i].matrix(), b.map.poses()[i].matrix());
  }
}

TEST(LoopClosing, WithoutImagesDepthAloneCloses) {
  Visit visit;
  const auto without_image = [&](int i) {
    GlobalKeyframe keyframe = views()[static_cast<std::size_t>(i)];
    keyframe.color = {};
    return keyframe;
  };
  for (int i = 0; i < kSteps; ++i) visit.add(without_image(i), Eigen::Isometry3d::Identity());
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  offset.translation().x() = 0.05;
  for (int i = kSteps - 1; i >= 0; --i) visit.add(without_image(i), offset);
  EXPECT_GE(accepted(visit.map), kSteps / 2);
}

GlobalKeyframe at_unknown_pose(int i, double seconds) {
  GlobalKeyframe frame = views()[static_cast<std::size_t>(i)];
  frame.T_world_sensor = {};
  frame.cloud.stamp = Timestamp::from_seconds(seconds);
  return frame;
}

TEST(Relocalization, TwoFramesOfAKnownPlaceGiveThePose) {
  Visit visit;
  for (const GlobalKeyframe& view : views()) visit.add(view, Eigen::Isometry3d::Identity());
  EXPECT_FALSE(visit.map.relocalize(at_unknown_pose(7, 100.0)));
  const auto place = visit.map.relocalize(at_unknown_pose(7, 100.1));
  ASSERT_TRUE(place);
  const Eigen::Isometry3d truth = views()[7].T_world_sensor.isometry();
  EXPECT_LT((place->T_world_sensor.translation() - truth.translation()).norm(), 0.03);
  EXPECT_FALSE(place->surroundings.empty());
}

/// No second keyframe confirms a loop there.
TEST(Relocalization, CorrectsThePoseOfASensorThatStandsThere) {
  Visit visit = there_and_back(0.005);
  GlobalKeyframe frame = at_unknown_pose(7, 100.0);
  EXPECT_FALSE(visit.map.relocalize(frame));
  frame.cloud.stamp = Timestamp::from_seconds(100.1);
  const auto place = visit.map.relocalize(frame);
  ASSERT_TRUE(place);
  EXPECT_FALSE(place->begins_session);
  frame.T_world_sensor = place->T_world_sensor;
  frame.after_lost = true;
  EXPECT_EQ(visit.map.add(frame).size(), 1U);
  const std::vector<Eigen::Isometry3d>& poses = visit.map.poses();
  EXPECT_LT((poses.back().translation() - poses[7].translation()).norm(), 0.04);
}

TEST(Relocalization, APlaceIsNoLoopOfALaterKeyframe) {
  Visit visit;
  for (const GlobalKeyframe& view : views()) visit.add(view, Eigen::Isometry3d::Identity());
  visit.map.relocalize(at_unknown_pose(7, 100.0));
  ASSERT_TRUE(visit.map.relocalize(at_unknown_pose(7, 100.1)));
  GlobalKeyframe later = views()[8];
  later.cloud.stamp = Timestamp::from_seconds(100.5);
  later.after_lost = true;
  EXPECT_TRUE(visit.map.add(later).empty()) << "one loop is not enough";
}

/// With people close to the sensor in one half of the view.
GlobalKeyframe half_covered(GlobalKeyframe frame, bool left) {
  LabeledCloud& cloud = frame.cloud;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const bool is_left = static_cast<int>(i) % cloud.width < cloud.width / 2;
    if (is_left != left || cloud.labels[i] == PointLabel::kInvalid) continue;
    cloud.points[i] *= 0.5F / cloud.points[i].z();
    cloud.labels[i] = PointLabel::kDynamic;
  }
  return frame;
}

TEST(Relocalization, HalfOfTheViewGivesThePose) {
  Visit visit;
  for (const GlobalKeyframe& view : views()) visit.add(view, Eigen::Isometry3d::Identity());
  int found = 0;
  double seconds = 100.0;
  for (const int i : {3, 5, 7, 9, 11, 13}) {
    for (const bool left : {false, true}) {
      visit.map.relocalize(half_covered(at_unknown_pose(i, seconds += 10.0), left));
      const auto place =
          visit.map.relocalize(half_covered(at_unknown_pose(i, seconds += 0.1), left));
      if (!place) continue;
      ++found;
      const Eigen::Isometry3d truth =
          views()[static_cast<std::size_t>(i)].T_world_sensor.isometry();
      EXPECT_LT((place->T_world_sensor.translation() - truth.translation()).norm(), 0.03);
    }
  }
  EXPECT_GE(found, 9);  // of twelve
}

/// A frame of which the odometry has the pose, in doubt.
GlobalKeyframe in_doubt(int i, double seconds) {
  GlobalKeyframe frame = views()[static_cast<std::size_t>(i)];
  frame.cloud.stamp = Timestamp::from_seconds(seconds);
  frame.has_pose = true;
  return frame;
}

TEST(Relocalization, GeometryConfirmsAPoseOnlyWithoutTexture) {
  Visit visit;
  for (const GlobalKeyframe& view : views()) visit.add(view, Eigen::Isometry3d::Identity());
  const Image<Rgb> other = views_of(2)[7].color;
  for (int k = 0; k < 10; ++k) {
    GlobalKeyframe frame = in_doubt(7, 100.0 + 0.1 * k);
    frame.color = other;
    EXPECT_FALSE(visit.map.relocalize(frame));
  }
  for (int k = 0; k < 6; ++k) {
    GlobalKeyframe frame = in_doubt(7, 110.0 + 0.1 * k);
    frame.color = Image<Rgb>(frame.color.width(), frame.color.height(), Rgb{});
    EXPECT_EQ(visit.map.relocalize(frame).has_value(), k == 5);
  }
}

/// With a person whom no mask covers, close to the sensor in a fifth of the columns.
GlobalKeyframe with_person(GlobalKeyframe frame) {
  LabeledCloud& cloud = frame.cloud;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const int column = static_cast<int>(i) % cloud.width;
    const bool is_person = column > 2 * cloud.width / 5 && column < 3 * cloud.width / 5;
    if (is_person && cloud.labels[i] != PointLabel::kInvalid) {
      cloud.points[i] *= 0.9F / cloud.points[i].z();
    }
  }
  return frame;
}

TEST(Relocalization, ManyKeypointsConfirmAPoseThoughAPersonWithoutMaskContradicts) {
  Visit visit;
  for (const GlobalKeyframe& view : views()) visit.add(view, Eigen::Isometry3d::Identity());
  for (int k = 0; k < 6; ++k) {
    EXPECT_FALSE(visit.map.relocalize(with_person(at_unknown_pose(7, 100.0 + 0.1 * k))))
        << "the place is not recognized";
  }
  for (int k = 0; k < 6; ++k) {
    const auto place = visit.map.relocalize(with_person(in_doubt(7, 110.0 + 0.1 * k)));
    ASSERT_EQ(place.has_value(), k == 5);
    if (!place) continue;
    const Eigen::Isometry3d truth = views()[7].T_world_sensor.isometry();
    EXPECT_LT((place->T_world_sensor.translation() - truth.translation()).norm(), 0.03);
  }
}

TEST(Relocalization, PlacesThatNoSensorMovesBetweenGiveNoPose) {
  Visit visit;
  for (const GlobalKeyframe& view : views()) visit.add(view, Eigen::Isometry3d::Identity());
  EXPECT_FALSE(visit.map.relocalize(at_unknown_pose(2, 100.0)));
  EXPECT_FALSE(visit.map.relocalize(at_unknown_pose(17, 100.1)));
}

TEST(Relocalization, AnUnknownPlaceThatIsSimilarGivesNoPose) {
  Visit visit;
  for (const GlobalKeyframe& view : views()) visit.add(view, Eigen::Isometry3d::Identity());
  double seconds = 100.0;
  for (GlobalKeyframe view : views_of(2)) {
    for (int repeat = 0; repeat < 2; ++repeat) {
      view.cloud.stamp = Timestamp::from_seconds(seconds += 0.05);
      EXPECT_FALSE(visit.map.relocalize(view));
    }
  }
}

/// Boxes and racks that repeat every 5.4 m agree with their keypoints and surfaces; marks on the
/// floor, and what is behind the racks, do not.
TEST(Relocalization, EqualRacksGiveNoPose) {
  SceneConfig config = aisle(1);
  config.hz = 15.0;
  const std::vector<GlobalKeyframe> known = views_of(config, 0, 25);
  const std::vector<GlobalKeyframe> later = views_of(config, 94, 106);
  const auto poses_by = [&](GlobalMap map) {
    Visit visit{std::move(map)};
    for (const GlobalKeyframe& view : known) visit.add(view, Eigen::Isometry3d::Identity());
    return std::count_if(later.begin(), later.end(), [&](const GlobalKeyframe& view) {
      return visit.map.relocalize(view).has_value();
    });
  };
  EXPECT_EQ(poses_by(make_map()), 0);
  EXPECT_GT(poses_by(make_map(1.0)), 0) << "the racks are not similar";
}

/// The sensor drives on, is covered, and is back at an earlier place when the light is on again.
std::vector<FrameResult> carried_back(int threads) {
  SimulatedScene scene([] {
    SceneConfig config = aisle(1);
    config.hz = 10.0;
    return config;
  }());
  SystemConfig config;
  SlamSystem system(config, std::make_unique<MaskSegmenter>());
  std::vector<Frame> frames;
  const auto add = [&](int i, bool dark) {
    Frame frame = scene.render(i).frame;
    if (dark) {
      std::fill(frame.depth.pixels().begin(), frame.depth.pixels().end(), 0.0F);
      std::fill(frame.color.pixels().begin(), frame.color.pixels().end(), Rgb{});
    }
    frame.index = static_cast<std::int64_t>(frames.size());
    frame.stamp = Timestamp(frame.index * 100'000'000);
    frames.push_back(std::move(frame));
  };
  for (int i = 0; i < 50; ++i) add(i, false);
  for (int i = 50; i < 55; ++i) add(i, true);
  for (int i = 20; i < 26; ++i) add(i, false);
  std::vector<FrameResult> results;
  std::size_t next = 0;
  AsyncPipeline({.threads = threads})
      .run(
          system,
          [&]() -> std::optional<Frame> {
            return next < frames.size() ? std::optional(frames[next++]) : std::nullopt;
          },
          [&](Processed&& processed) { results.push_back(std::move(processed.result)); });
  return results;
}

TEST(Relocalization, SensorThatWasCarriedInTheDarkContinuesWhereItIs) {
  const std::vector<FrameResult> results = carried_back(1);
  ASSERT_EQ(results.size(), 61U);
  for (std::size_t i = 50; i < 55; ++i) EXPECT_EQ(results[i].odometry.status, Status::kLost);
  std::size_t relocalized = 0;
  for (std::size_t i = 55; i < results.size(); ++i) {
    const FrameResult& result = results[i];
    relocalized += result.relocalized;
    if (result.odometry.status == Status::kLost) continue;
    const Eigen::Vector3d before = results[i - 35].odometry.T_world_sensor.translation();
    EXPECT_LT((result.odometry.T_world_sensor.translation() - before).norm(), 0.05) << i;
  }
  EXPECT_EQ(relocalized, 1U);
  EXPECT_EQ(results.back().odometry.status, Status::kTracking);
}

TEST(Relocalization, IsTheSameForAnyNumberOfThreads) {
  const std::vector<FrameResult> one = carried_back(1);
  const std::vector<FrameResult> two = carried_back(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].odometry.T_world_sensor.isometry().matrix(),
              two[i].odometry.T_world_sensor.isometry().matrix());
    EXPECT_EQ(one[i].relocalized, two[i].relocalized);
    ASSERT_TRUE(one[i].correction.T_global_world && two[i].correction.T_global_world);
    EXPECT_EQ(one[i].correction.T_global_world->isometry().matrix(),
              two[i].correction.T_global_world->isometry().matrix());
  }
}

/// Results of the frames of a part of the aisle, 10 a second.
std::vector<FrameResult> drive(SlamSystem& system, int first, int end) {
  SceneConfig config = aisle(1);
  config.hz = 10.0;
  SimulatedScene scene(config);
  std::vector<FrameResult> results;
  for (int i = first; i < end; ++i) results.push_back(system.process(scene.render(i).frame));
  return results;
}

TEST(Relocalization, PoseInAnEarlierMapIsUnknownUntilItsPlaceIsRecognized) {
  SystemConfig config;
  SlamSystem earlier(config, std::make_unique<MaskSegmenter>());
  const std::vector<FrameResult> before = drive(earlier, 0, 60);
  for (const FrameResult& result : before) {
    ASSERT_TRUE(result.correction.T_global_world);
    EXPECT_TRUE(result.correction.T_global_world->isometry().isApprox(Eigen::Isometry3d::Identity(),
                                                                      1e-12));
  }
  SlamSystem later(config, std::make_unique<MaskSegmenter>());
  const GlobalMap& map = earlier.global_map();
  later.restore({map.records(), map.poses(), map.loops()}, MapUse::kLocalizeOnly);
  const int first = 25;
  const std::vector<FrameResult> results = drive(later, first, 50);
  EXPECT_FALSE(results.front().correction.T_global_world);
  ASSERT_TRUE(results.back().correction.T_global_world);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].correction.T_global_world) continue;
    const Eigen::Isometry3d pose =
        (*results[i].correction.T_global_world * results[i].odometry.T_world_sensor).isometry();
    const Eigen::Isometry3d& expected = before[i + first].odometry.T_world_sensor.isometry();
    EXPECT_LT((pose.translation() - expected.translation()).norm(), 0.03) << i;
  }
}

TEST(Relocalization, ASensorThatStandsIsSearchedForEverMoreRarely) {
  SystemConfig config;
  SlamSystem earlier(config, std::make_unique<MaskSegmenter>());
  drive(earlier, 0, 30);
  SlamSystem later(config, std::make_unique<MaskSegmenter>());
  const GlobalMap& map = earlier.global_map();
  later.restore({map.records(), map.poses(), map.loops()}, MapUse::kLocalizeOnly);
  Frame frame = SimulatedScene(aisle(2)).render(0).frame;
  int in_the_first_seconds = 0;
  int after = 0;
  for (int i = 0; i < 200; ++i) {
    frame.index = i;
    frame.stamp = Timestamp(i * std::int64_t{100'000'000});
    (i <= 60 ? in_the_first_seconds : after) += later.process(frame).global_keyframe;
  }
  EXPECT_GE(in_the_first_seconds, 20);
  EXPECT_GT(after, 10);
  EXPECT_LT(after, 45);
}

}  // namespace
}  // namespace mms
