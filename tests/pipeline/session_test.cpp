// Sessions of a run: the sensor is carried in the dark to a place that it has not seen, goes on
// there, and comes back to the places before.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "mms/pipeline/async_pipeline.hpp"
#include "mms/pipeline/live_map.hpp"
#include "mms/pipeline/session_places.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {
namespace {

constexpr int kNoLight = -1;      // darkness
constexpr std::size_t kDark = 5;  // its frames
constexpr std::size_t kBegin =
    28 + kDark + 29;  // the session's first frame: the 30th in the light, 3 s

/// A run over images at given places of a path, ten of them a second. The path has a corner: what
/// is seen before it is not seen after it.
struct Carried {
  std::vector<int> places;  ///< by frame: image of the path; kNoLight is dark
  std::vector<FrameResult> results;
  std::unique_ptr<SlamSystem> system;

  std::size_t session_begin() const {
    const auto first = std::find_if(results.begin(), results.end(),
                                    [](const FrameResult& result) { return result.session == 1; });
    return static_cast<std::size_t>(first - results.begin());
  }

  /// Position of the first frame at a place.
  Eigen::Vector3d first_position_at(int place) const {
    const auto i = std::find(places.begin(), places.end(), place) - places.begin();
    return results[static_cast<std::size_t>(i)].odometry.T_world_sensor.translation();
  }
};

/// How the sensor comes back to the places of the first session.
enum class Return { kNone, kDrives, kIsCarried };

Carried carried_away(int threads, Return back) {
  Carried run;
  for (int i = 212; i < 240; ++i) run.places.push_back(i);
  run.places.insert(run.places.end(), kDark, kNoLight);
  for (int i = 165; i < (back == Return::kDrives ? 236 : 203); ++i) run.places.push_back(i);
  if (back == Return::kIsCarried) {
    run.places.insert(run.places.end(), kDark, kNoLight);
    for (int i = 216; i < 230; ++i) run.places.push_back(i);
  }
  SceneConfig scene_config = mms::scene_config("warehouse_loop");
  scene_config.width = 320;
  scene_config.hz = 10.0;
  SimulatedScene scene(scene_config);
  SystemConfig config;
  run.system = std::make_unique<SlamSystem>(config, std::make_unique<MaskSegmenter>());
  std::size_t next = 0;
  AsyncPipeline({.threads = threads})
      .run(
          *run.system,
          [&]() -> std::optional<Frame> {
            if (next == run.places.size()) return std::nullopt;
            const int place = run.places[next];
            Frame frame = scene.render(std::max(place, 0)).frame;
            if (place == kNoLight) {
              std::fill(frame.depth.pixels().begin(), frame.depth.pixels().end(), 0.0F);
              std::fill(frame.color.pixels().begin(), frame.color.pixels().end(), Rgb{});
            }
            frame.index = static_cast<std::int64_t>(next++);
            frame.stamp = Timestamp(frame.index * 100'000'000);
            return frame;
          },
          [&](Processed&& processed) { run.results.push_back(std::move(processed.result)); });
  run.system->finalize();
  return run;
}

TEST(Session, BeginsWhereALostSensorSeesEnoughForSecondsButNoKnownPlace) {
  const Carried run = carried_away(1, Return::kNone);
  const std::size_t begin = run.session_begin();
  ASSERT_EQ(begin, kBegin);
  for (std::size_t i = 28; i < begin; ++i) {
    EXPECT_EQ(run.results[i].odometry.status, Status::kLost) << i;
  }
  EXPECT_EQ(run.results[begin].odometry.status, Status::kInitialized);
  EXPECT_TRUE(run.results[begin].keyframe);
  EXPECT_TRUE(run.results[begin].global_keyframe);
  for (std::size_t i = begin; i < run.results.size(); ++i) {
    EXPECT_EQ(run.results[i].session, 1U);
    EXPECT_FALSE(run.results[i].correction.T_global_world) << "its place in the map is not known";
    EXPECT_EQ(run.results[i].odometry.status,
              i == begin ? Status::kInitialized : Status::kTracking);
  }
  // Without a known place, its map is its own.
  const std::vector<SessionPlace> places = session_places(run.system->global_map(), 2);
  EXPECT_TRUE(places[0].is_known);
  EXPECT_FALSE(places[1].is_known);
  const std::vector<StampedMap> maps = run.system->mapping().session_maps();
  ASSERT_EQ(maps.size(), 2U);
  const MapCloud joined = joined_map(maps, places);
  EXPECT_LE(joined.size(), maps[0].cloud.size());
  EXPECT_EQ(live_map(run.system->mapping(), run.results.back()).points, maps[1].cloud.points);
  EXPECT_GT(maps[1].cloud.size(), maps[0].cloud.size() / 10);
}

/// With one thread.
const Carried& carried_away_and_back() {
  static const Carried kRun = carried_away(1, Return::kDrives);
  return kRun;
}

TEST(Session, IsJoinedToTheMapWhereItSeesAKnownPlace) {
  const Carried& run = carried_away_and_back();
  ASSERT_EQ(run.session_begin(), kBegin);
  const FrameResult& last = run.results.back();
  ASSERT_EQ(last.session, 1U);
  ASSERT_TRUE(last.correction.T_global_world);
  const Eigen::Vector3d there = run.first_position_at(run.places.back());
  const Eigen::Vector3d now =
      (*last.correction.T_global_world * last.odometry.T_world_sensor).isometry().translation();
  EXPECT_LT((now - there).norm(), 0.05);
  EXPECT_GT((last.odometry.T_world_sensor.translation() - there).norm(), 0.2)
      << "the world of the session goes on from a guess";
  const std::vector<SessionPlace> places = session_places(run.system->global_map(), 2);
  EXPECT_TRUE(places[0].is_known && places[1].is_known);
  // The live map has both sessions, in the world of the present one.
  const std::vector<SessionPlace> known = places_at(last);
  ASSERT_EQ(known.size(), 2U);
  EXPECT_TRUE(known[0].is_known && known[1].is_known);
  const MapCloud both = joined_map(run.system->mapping().session_maps(), known);
  const MapCloud live = live_map(run.system->mapping(), last);
  ASSERT_EQ(live.size(), both.size());
  const Eigen::Isometry3d T_global_world = last.correction.T_global_world->isometry();
  for (std::size_t i = 0; i < live.size(); ++i) {
    const Eigen::Vector3d point = T_global_world * live.points[i].cast<double>();
    ASSERT_LT((point - both.points[i].cast<double>()).norm(), 1e-4);
  }
  // Both maps show the same place.
  const std::vector<StampedMap> maps = run.system->mapping().session_maps();
  const MapCloud joined = joined_map(maps, places);
  EXPECT_LT(joined.size(), maps[0].cloud.size() + maps[1].cloud.size());
  EXPECT_GT(joined.size(), maps[0].cloud.size());
}

TEST(Session, BeginsAtAPlaceOfAnEarlierSessionWhereALostSensorIsRelocalized) {
  const Carried run = carried_away(1, Return::kIsCarried);
  const FrameResult& last = run.results.back();
  ASSERT_EQ(last.session, 2U);
  const auto first = std::find_if(run.results.begin(), run.results.end(),
                                  [](const FrameResult& result) { return result.session == 2; });
  EXPECT_TRUE(first->relocalized);
  EXPECT_TRUE(first->global_keyframe);
  for (auto result = first; result != run.results.end(); ++result) {
    ASSERT_TRUE(result->correction.T_global_world) << "its place is known from the start";
    EXPECT_NE(result->odometry.status, Status::kLost);
    const int place = run.places[static_cast<std::size_t>(result - run.results.begin())];
    EXPECT_LT((result->odometry.T_world_sensor.translation() - run.first_position_at(place)).norm(),
              0.05)
        << "its world is the frame of the map";
  }
  const std::vector<SessionPlace> places = session_places(run.system->global_map(), 3);
  EXPECT_TRUE(places[0].is_known);
  EXPECT_FALSE(places[1].is_known);
  EXPECT_TRUE(places[2].is_known);
}

TEST(Session, IsTheSameForAnyNumberOfThreads) {
  const Carried& one = carried_away_and_back();
  const Carried two = carried_away(2, Return::kDrives);
  ASSERT_EQ(one.results.size(), two.results.size());
  for (std::size_t i = 0; i < one.results.size(); ++i) {
    EXPECT_EQ(one.results[i].session, two.results[i].session);
    EXPECT_EQ(one.results[i].odometry.T_world_sensor.isometry().matrix(),
              two.results[i].odometry.T_world_sensor.isometry().matrix());
    ASSERT_EQ(one.results[i].correction.T_global_world.has_value(),
              two.results[i].correction.T_global_world.has_value());
    if (!one.results[i].correction.T_global_world) continue;
    EXPECT_EQ(one.results[i].correction.T_global_world->isometry().matrix(),
              two.results[i].correction.T_global_world->isometry().matrix());
  }
  const auto map_of = [](const Carried& run) {
    return joined_map(run.system->mapping().session_maps(),
                      session_places(run.system->global_map(), 2));
  };
  EXPECT_EQ(map_of(one).points, map_of(two).points);
}

TEST(SessionPlace, KnowsNoPoseWithoutAPlace) {
  const Transform<World, Sensor> pose(Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3)));
  SessionPlace place;
  EXPECT_EQ(place.corrected(Timestamp(5), pose)->translation(), pose.translation());
  place.correction.add(Timestamp(0),
                       Transform<Global, World>(Eigen::Isometry3d(Eigen::Translation3d(10, 0, 0))));
  EXPECT_EQ(place.corrected(Timestamp(5), pose)->translation(), Eigen::Vector3d(11, 2, 3));
  place.is_known = false;
  EXPECT_FALSE(place.corrected(Timestamp(5), pose));
}

}  // namespace
}  // namespace mms
