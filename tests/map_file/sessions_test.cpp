// Sessions of one map: a later run finds its place in the map of an earlier one, and maps are
// merged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/map_file/map_composition.hpp"
#include "mms/map_file/map_merge.hpp"
#include "mms/map_file/session_changes.hpp"
#include "tests/map_file/stored_visit.hpp"

namespace mms {
namespace {

using namespace testing;

double distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

GlobalMapContent first_session() {
  GlobalMap map = empty_map();
  drive(map, 0, kSteps, Eigen::Isometry3d::Identity());
  return {map.records(), map.poses(), map.loops()};
}

TEST(Sessions, ALaterRunFindsItsPlaceInTheMap) {
  for (const MapUse use : {MapUse::kExtend, MapUse::kLocalizeOnly}) {
    GlobalMap map = empty_map();
    map.restore(first_session(), use);
    EXPECT_EQ(map.session(), 1U);
    drive(map, 4, 16, other_world());
    ASSERT_TRUE(map.is_joined(1));
    for (std::size_t i = 0; i < 12; ++i) {
      const Eigen::Isometry3d truth = views()[4 + i].T_world_sensor.isometry();
      EXPECT_LT(distance(map.poses()[kSteps + i], truth), 0.03) << i;
    }
    const Eigen::Isometry3d corrected = map.correction().at(map.records().back().stamp).isometry() *
                                        map.records().back().T_world_sensor.isometry();
    EXPECT_LT(distance(corrected, views()[15].T_world_sensor.isometry()), 0.03);
  }
}

TEST(Sessions, LocalizationChangesNoPoseOfTheMapAndKeepsNoKnownPlace) {
  const GlobalMapContent before = first_session();
  GlobalMap map = empty_map();
  map.restore(before, MapUse::kLocalizeOnly);
  drive(map, 4, 16, other_world());
  for (std::size_t i = 0; i < before.poses.size(); ++i) {
    EXPECT_EQ(map.poses()[i].matrix(), before.poses[i].matrix());
  }
  const auto kept = std::count_if(map.records().begin() + kSteps, map.records().end(),
                                  [](const KeyframeRecord& r) { return !r.is_pose_only(); });
  EXPECT_LE(kept, 6);
}

TEST(Sessions, APlaceThatIsNotInTheMapIsNotFound) {
  GlobalMap map = empty_map();
  map.restore(first_session(), MapUse::kExtend);
  for (const GlobalKeyframe& view : views_of(2)) map.add(view);
  EXPECT_FALSE(map.is_joined(1));
  EXPECT_TRUE(map.correction().empty());
}

TEST(Sessions, RestoredMapIsEqualToTheOneThatWasSaved) {
  GlobalMap through_file = empty_map();
  const TempFolder folder;
  write_first_session(folder.path() / "a.mmsmap");
  through_file.restore(MapFile(folder.path() / "a.mmsmap", MapFile::Mode::kRead).content(refuse),
                       MapUse::kExtend);
  GlobalMap in_memory = empty_map();
  in_memory.restore(first_session(), MapUse::kExtend);
  for (GlobalMap* map : {&through_file, &in_memory}) drive(*map, 2, 12, other_world());
  ASSERT_EQ(through_file.poses().size(), in_memory.poses().size());
  for (std::size_t i = 0; i < in_memory.poses().size(); ++i) {
    EXPECT_LT(distance(through_file.poses()[i], in_memory.poses()[i]), 1e-6);
  }
  EXPECT_EQ(through_file.loops().size(), in_memory.loops().size());
}

/// The wall of a room at 4 m, with a box of 1 m before it.
KeyframeRecord seen_room(std::uint32_t session, double x, bool with_box, Timestamp stamp) {
  KeyframeRecord record;
  record.session = session;
  record.stamp = stamp;
  record.features.planes.emplace_back();
  record.T_world_sensor =
      Transform<World, Sensor>(Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)));
  record.view.camera = {80.0, 80.0, 39.5, 29.5, 80, 60, {}};
  record.view.depth_mm = Image<std::uint16_t>(80, 60);
  record.view.is_static = Image<std::uint8_t>(80, 60);
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) {
      const double at_box_x = x + 2.0 * (u - 39.5) / 80.0;
      const double at_box_y = 2.0 * (v - 29.5) / 80.0;
      const bool box = with_box && std::abs(at_box_x) < 0.5 && std::abs(at_box_y) < 0.5;
      record.view.depth_mm(u, v) = box ? 2000 : 4000;
      record.view.is_static(u, v) = 1;
    }
  }
  return record;
}

/// Sessions of a room with or without a box, which comes first in their spatial order.
/// @param joined  number of the sessions that loops join
/// @param edit    changes each keyframe
/// @param begins  of the sessions [s]
std::vector<Change> changes_of(const std::vector<bool>& boxes, const std::string& name,
                               std::size_t joined,
                               const std::function<void(KeyframeRecord&)>& edit = {},
                               const std::vector<std::int64_t>& begins = {}) {
  const TempFolder folder;
  GlobalMapContent content;
  const auto surfaces = [&](bool with_box) {
    StampedMap result;
    const auto add = [&](float x, float z) {
      result.cloud.points.emplace_back(x, 0.0F, z);
      result.cloud.normals.emplace_back(0.0F, 0.0F, -1.0F);
      result.cloud.colors.push_back({});
      result.cloud.observations.push_back(3);
      result.stamps.push_back(Timestamp(1));
    };
    add(-1.5F, 4.0F);  // wall that every view shows
    add(9.0F, 4.0F);   // out of every view
    if (with_box) add(0.0F, 2.0F);
    return result;
  };
  MapFile file(folder.path() / name, MapFile::Mode::kCreate);
  for (std::uint32_t session = 0; session < boxes.size(); ++session) {
    const bool with_box = boxes[session];
    for (const double x : {0.0, 0.1, 0.2}) {
      content.records.push_back(seen_room(session, x, with_box, Timestamp(1)));
      if (edit) edit(content.records.back());
      content.poses.push_back(content.records.back().T_world_sensor.isometry());
    }
    MapSession described = some_session(name);
    if (!begins.empty()) described.begin = Timestamp(begins[session] * 1'000'000'000);
    file.add_session(described, surfaces(with_box), content.records);
  }
  for (std::size_t session = 1; session < joined; ++session) {
    Loop loop;
    loop.candidate = 0;
    loop.query = 3 * session;
    loop.outcome = LoopOutcome::kAccepted;
    content.loops.push_back(loop);
  }
  file.set_graph(content.poses, content.loops);
  return find_changes(file, content, DepthNoise{}, refuse).changes;
}

TEST(MapChanges, AreFoundByFreeSpace) {
  using enum Change;
  EXPECT_EQ(changes_of({true, false}, "gone", 2),
            (std::vector{kGone, kUnchanged, kUnknown, kUnchanged, kUnknown}));
  EXPECT_EQ(changes_of({false, true}, "new", 2),
            (std::vector{kUnchanged, kUnknown, kNew, kUnchanged, kUnknown}));
  EXPECT_EQ(changes_of({true, true}, "same", 2),
            (std::vector{kUnchanged, kUnchanged, kUnknown, kUnchanged, kUnchanged, kUnknown}));
}

TEST(MapChanges, TheLastSessionTellsWhatIsGone) {
  using enum Change;
  EXPECT_EQ(changes_of({true, true, false}, "gone", 3),
            (std::vector{kGone, kUnchanged, kUnknown, kGone, kUnchanged, kUnknown, kUnchanged,
                         kUnknown}));
  EXPECT_EQ(changes_of({true, false, true}, "back", 3),
            (std::vector{kUnchanged, kUnchanged, kUnknown, kUnchanged, kUnknown, kNew, kUnchanged,
                         kUnknown}));
}

TEST(MapChanges, PeopleAreNoSurfaces) {
  using enum Change;
  const auto person = [](KeyframeRecord& record) {  // where the box was, in one view
    if (record.session != 1 || record.T_world_sensor.translation().x() != 0.0) return;
    for (int v = 0; v < 60; ++v) {
      for (int u = 0; u < 80; ++u) {
        if (std::abs(u - 39.5) > 20.0 || std::abs(v - 29.5) > 20.0) continue;
        record.view.depth_mm(u, v) = 2000;
        record.view.is_static(u, v) = 0;
      }
    }
  };
  EXPECT_EQ(changes_of({true, false}, "person", 2, person),
            (std::vector{kGone, kUnchanged, kUnknown, kUnchanged, kUnknown}));
}

TEST(MapChanges, SessionsAreComparedInTime) {  // written: Monday, Wednesday, Tuesday
  using enum Change;
  EXPECT_EQ(
      changes_of({true, false, true}, "time", 3, {}, {1'700'000'000, 1'700'172'800, 1'700'086'400}),
      (std::vector{kGone, kUnchanged, kUnknown, kGone, kUnchanged, kUnknown, kUnchanged,
                   kUnknown}));
}

TEST(MapChanges, SessionsInAnotherFrameSayNothing) {
  using enum Change;
  EXPECT_EQ(changes_of({true, true, false}, "other", 2),
            (std::vector{kUnchanged, kUnchanged, kUnknown, kUnchanged, kUnchanged, kUnknown}));
}

void write_part(const std::filesystem::path& path, int first, int end, std::uint64_t seed,
                const Eigen::Isometry3d& world) {
  GlobalMap map = empty_map();
  drive(map, first, end, world);
  MapFile file(path, MapFile::Mode::kCreate);
  file.add_session(some_session(path.filename()), some_surfaces(map, 2000, seed), map.records());
  file.set_graph(map.poses(), map.loops());
  file.commit();
}

MapCloud merged_map(const std::vector<std::filesystem::path>& maps,
                    const std::filesystem::path& path) {
  MapMerge merge(maps, refuse);
  GlobalMap map = empty_map();
  EXPECT_EQ(merge.join(map, [](std::size_t, std::size_t) {}), maps.size());
  merge.write(path, map, refuse);
  const MapFile file(path, MapFile::Mode::kRead);
  EXPECT_TRUE(file.check().empty());
  return composed_map(file, file.content(refuse), refuse);
}

TEST(MapMerge, OrderOfTheMapsDoesNotMatter) {
  const TempFolder folder;
  write_part(folder.path() / "a", 0, 12, 1, Eigen::Isometry3d::Identity());
  write_part(folder.path() / "b", 6, 18, 2, other_world());
  write_part(folder.path() / "c", 16, 3, 3, other_world().inverse());
  const MapCloud one = merged_map({folder.path() / "a", folder.path() / "b", folder.path() / "c"},
                                  folder.path() / "abc");
  const MapCloud two = merged_map({folder.path() / "c", folder.path() / "a", folder.path() / "b"},
                                  folder.path() / "cab");
  ASSERT_EQ(one.size(), two.size());
  ASSERT_GT(one.size(), 3000U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one.points[i], two.points[i]);
    ASSERT_EQ(one.observations[i], two.observations[i]);
  }
}

TEST(MapMerge, JoinsWorldsThatWereUnrelated) {
  const TempFolder folder;
  write_part(folder.path() / "a", 0, 12, 1, Eigen::Isometry3d::Identity());
  write_part(folder.path() / "b", 6, 18, 2, other_world());
  merged_map({folder.path() / "a", folder.path() / "b"}, folder.path() / "ab");
  const GlobalMapContent content =
      MapFile(folder.path() / "ab", MapFile::Mode::kRead).content(refuse);
  ASSERT_EQ(content.records.size(), 24U);
  // Either may be the first one; their relative poses are those of the scene.
  const bool a_first = (content.records[0].T_world_sensor.isometry().matrix() -
                        views()[0].T_world_sensor.isometry().matrix())
                           .norm() < 1e-6;
  const auto view = [&](std::size_t i) {
    const bool of_a = (i < 12) == a_first;
    return views()[i % 12 + (of_a ? 0 : 6)].T_world_sensor.isometry();
  };
  const Eigen::Isometry3d T = content.poses[0] * view(0).inverse();
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_LT(distance(content.poses[i], T * view(i)), 0.03) << i;
  }
}

TEST(MapMerge, TakesKeyframesOfWhichOnlyThePoseIsKept) {
  const TempFolder folder;
  write_part(folder.path() / "a", 0, 12, 1, Eigen::Isometry3d::Identity());
  GlobalMap visited = empty_map();
  drive(visited, 6, 18, other_world());
  std::deque<KeyframeRecord> records = visited.records();
  records[6].features = {};  // as at a place that was visited often
  records[6].keypoints = {};
  records[6].view = {};
  {
    MapFile file(folder.path() / "b", MapFile::Mode::kCreate);
    file.add_session(some_session("b"), some_surfaces(visited, 2000, 2), records);
    file.set_graph(visited.poses(), visited.loops());
    file.commit();
  }
  EXPECT_GT(merged_map({folder.path() / "a", folder.path() / "b"}, folder.path() / "ab").size(),
            3000U);
}

TEST(MapMerge, RefusesACopy) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  std::filesystem::copy_file(folder.path() / "a", folder.path() / "b");
  EXPECT_THROW(MapMerge({folder.path() / "a", folder.path() / "b"}, refuse), DataError);
}

TEST(Sessions, ASecondVisitOfItsOwnIsComparedWithTheMap) {
  GlobalMap map = empty_map();
  map.restore(first_session(), MapUse::kExtend);
  const auto lap = [&](bool has_image) {
    for (int i = 4; i < 16; ++i) {
      GlobalKeyframe view = views()[static_cast<std::size_t>(i)];
      view.T_world_sensor =
          Transform<World, Sensor>(other_world() * view.T_world_sensor.isometry());
      view.cloud.stamp =
          Timestamp(static_cast<std::int64_t>(map.records().size() + 1) * 500'000'000);
      if (!has_image) view.color = {};
      map.add(view);
    }
  };
  lap(false);  // depth alone recognizes no place
  ASSERT_FALSE(map.is_joined(1));
  lap(true);
  EXPECT_TRUE(map.is_joined(1));
}

TEST(MapMerge, KeepsTheLoopsOfKeyframesOfWhichOnlyThePoseIsKept) {
  const TempFolder folder;
  write_part(folder.path() / "a", 0, 12, 1, Eigen::Isometry3d::Identity());
  GlobalMap visited = empty_map();
  drive(visited, 6, 18, other_world());
  std::deque<KeyframeRecord> records = visited.records();
  std::vector<Eigen::Isometry3d> poses = visited.poses();
  std::vector<Loop> loops;
  for (std::size_t i = 0; i < 12; ++i) {  // a second visit that drifts by 1 cm a keyframe
    KeyframeRecord again;
    again.stamp = Timestamp(static_cast<std::int64_t>(records.size() + 1) * 500'000'000);
    Eigen::Isometry3d drifted = records[i].T_world_sensor.isometry();
    drifted.pretranslate(Eigen::Vector3d(0.01 * static_cast<double>(i + 1), 0.0, 0.0));
    again.T_world_sensor = Transform<World, Sensor>(drifted);
    Loop loop;
    loop.candidate = i;
    loop.query = records.size();
    loop.outcome = LoopOutcome::kAccepted;
    loop.information = 1e6 * Matrix6d::Identity();
    loops.push_back(loop);
    poses.push_back(poses[i]);
    records.push_back(again);
  }
  {
    MapFile file(folder.path() / "b", MapFile::Mode::kCreate);
    MapSession session = some_session("b");
    session.begin = Timestamp(600'000'000);  // the second part
    file.add_session(session, some_surfaces(visited, 2000, 2), records);
    file.set_graph(poses, loops);
    file.commit();
  }
  MapMerge merge({folder.path() / "a", folder.path() / "b"}, refuse);
  GlobalMap map = empty_map();
  merge.join(map, [](std::size_t, std::size_t) {});
  EXPECT_LT(distance(map.poses()[12 + 11], map.poses()[12 + 23]), 0.03);  // 0.12 by odometry
}

TEST(MapMerge, TakesASharedSessionOnce) {
  const TempFolder folder;
  write_first_session(folder.path() / "a");
  std::filesystem::copy_file(folder.path() / "a", folder.path() / "b");
  {
    MapFile file(folder.path() / "b", MapFile::Mode::kExtend);
    GlobalMap map = empty_map();
    map.restore(file.content(refuse), MapUse::kExtend);
    drive(map, 4, 12, other_world());
    file.add_session(some_session("second"), some_surfaces(map, 3000, 2), map.records());
    file.set_graph(map.poses(), map.loops());
    file.commit();
  }
  MapMerge merge({folder.path() / "a", folder.path() / "b"}, refuse);
  EXPECT_EQ(merge.sessions(), 2U);
  GlobalMap map = empty_map();
  EXPECT_EQ(merge.join(map, [](std::size_t, std::size_t) {}), 2U);
  EXPECT_EQ(map.records().size(), kSteps + 8U);
  merge.write(folder.path() / "ab", map, refuse);
  EXPECT_EQ(MapFile(folder.path() / "ab", MapFile::Mode::kRead).sessions().size(), 2U);
}

/// As in maps that a former version merged.
TEST(MapMerge, TakesASessionOnceThatOneMapHasTwice) {
  const TempFolder folder;
  write_part(folder.path() / "a", 0, 12, 1, Eigen::Isometry3d::Identity());
  GlobalMap map = empty_map();
  drive(map, 6, 18, other_world());
  std::deque<KeyframeRecord> records = map.records();
  std::vector<Eigen::Isometry3d> poses = map.poses();
  for (std::size_t i = 0; i < map.records().size(); ++i) {
    records.push_back(map.records()[i]);
    records.back().session = 1;
    poses.push_back(map.poses()[i]);
  }
  {
    MapFile file(folder.path() / "b", MapFile::Mode::kCreate);
    MapSession session = some_session("b");
    session.begin = Timestamp(600'000'000);  // after that of the first map
    for (int i = 0; i < 2; ++i) file.add_session(session, some_surfaces(map, 100, 2), records);
    file.set_graph(poses, map.loops());
    file.commit();
  }
  MapMerge merge({folder.path() / "a", folder.path() / "b"}, refuse);
  GlobalMap joined = empty_map();
  EXPECT_EQ(merge.join(joined, [](std::size_t, std::size_t) {}), 2U);
  EXPECT_EQ(joined.records().size(), 24U);
  merge.write(folder.path() / "ab", joined, refuse);
  EXPECT_TRUE(MapFile(folder.path() / "ab", MapFile::Mode::kRead).check().empty());
}

TEST(MapMerge, KeepsSessionsOfAMapJoined) {
  const TempFolder folder;
  write_part(folder.path() / "a", 0, 12, 1, Eigen::Isometry3d::Identity());
  GlobalMap two = empty_map();
  drive(two, 6, 18, other_world());
  for (GlobalKeyframe view : views_of(2)) {  // places that nothing recognizes
    view.session = 1;
    view.cloud.stamp = Timestamp(static_cast<std::int64_t>(two.records().size() + 1) * 500'000'000);
    two.add(view);
  }
  std::vector<Loop> loops = two.loops();
  Loop& joins = loops.emplace_back();  // as after a loss
  joins.query = 12;
  joins.outcome = LoopOutcome::kAccepted;
  joins.information = 1e6 * Matrix6d::Identity();
  {
    MapFile file(folder.path() / "b", MapFile::Mode::kCreate);
    MapSession session = some_session("b");
    session.begin = Timestamp(600'000'000);
    for (int i = 0; i < 2; ++i) {
      file.add_session(session, some_surfaces(two, 100, 2), two.records());
    }
    file.set_graph(two.poses(), loops);
    file.commit();
  }
  MapMerge merge({folder.path() / "a", folder.path() / "b"}, refuse);
  GlobalMap map = empty_map();
  EXPECT_EQ(merge.join(map, [](std::size_t, std::size_t) {}), 3U);
}

}  // namespace
}  // namespace mms
