// Map files by the commands of the program.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

constexpr const char* kFirstDay = "sim:rack_aisle?width=320&hz=3&frames=12";
constexpr const char* kSecondDay = "sim:rack_aisle?width=320&hz=3&frames=12&day=1";

/// A run with exact masks and more arguments.
Outcome run_day(const TempFolder& folder, const std::string& day, const std::string& output,
                const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"run", day, "-o", output};
  if (std::find(more.begin(), more.end(), "--segmenter") == more.end()) {
    arguments.insert(arguments.end(), {"--segmenter", "masks"});
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_mms(folder.path(), arguments);
}

nlohmann::json loops_of(const TempFolder& folder, const std::string& output) {
  return nlohmann::json::parse(read_file(folder.path() / output / "metrics.json"))["loops"];
}

/// First vertex of a line of the report's first plot.
std::string first_vertex(const std::string& html, const std::string& color) {
  const std::size_t begin = html.find("d=\"M", html.find("class=\"line " + color + "\"")) + 4;
  return html.substr(begin, html.find_first_of("hLM\"", begin) - begin);
}

TEST(Map, IsSavedLocalizedInExtendedAndExported) {
  const TempFolder folder;
  const Outcome first = run_day(folder, kFirstDay, "first", {"--save-map", "a.mmsmap"});
  expect_success(first);
  EXPECT_NE(first.out.find("saved:  a.mmsmap"), std::string::npos) << first.out;
  const std::string map = read_file(folder.path() / "a.mmsmap");
  folder.write("one.mmsmap", map);

  expect_success(run_day(folder, kSecondDay, "second", {"--map", "a.mmsmap", "--localize"}));
  EXPECT_EQ(read_file(folder.path() / "a.mmsmap"), map);
  const nlohmann::json loops = loops_of(folder, "second");
  EXPECT_EQ(loops["earlier_map"]["sessions"], 1);
  EXPECT_GT(loops["earlier_map"]["closed"], 1);
  ASSERT_TRUE(loops["earlier_map"]["localized_s"].is_number());
  const std::string closed = loops["closed"].dump();
  const std::string note = closed + (closed == "1" ? " loop, " : " loops, ") +
                           loops["earlier_map"]["closed"].dump() + " to the map.";
  const std::string report = read_file(folder.path() / "second/report.html");
  EXPECT_NE(report.find(note), std::string::npos) << note;
  ASSERT_NE(report.find("odometry</span>"), std::string::npos);
  EXPECT_EQ(first_vertex(report, "c4"), first_vertex(report, "c0"));  // odometry, estimate

  expect_success(run_day(folder, kSecondDay, "third", {"--map", "a.mmsmap"}));
  const Outcome info = run_mms(folder.path(), {"info", "a.mmsmap"});
  expect_success(info);
  EXPECT_NE(info.out.find("2 sessions"), std::string::npos) << info.out;
  const Outcome described = run_mms(folder.path(), {"info", "a.mmsmap", "--json"});
  expect_success(described);
  const nlohmann::json json = nlohmann::json::parse(described.out);
  ASSERT_EQ(json["sessions"].size(), 2U);
  EXPECT_EQ(json["sessions"][1]["frames"], 12);
  EXPECT_EQ(json["sessions"][1]["joined"], true);
  EXPECT_GT(json["sessions"][1]["points"], 1000);
  EXPECT_EQ(json["sessions"][0]["camera"]["width"], 320);
  EXPECT_GE(json["loops"], 1);
  expect_success(run_mms(folder.path(), {"map", "check", "a.mmsmap"}));
  expect_success(run_mms(folder.path(), {"map", "compact", "a.mmsmap"}));
  expect_success(run_mms(folder.path(), {"map", "export", "a.mmsmap", "-o", "export"}));
  EXPECT_GT(read_ply(folder.path() / "export/static_map.ply").points.size(), 5000U);
  EXPECT_GT(read_ply(folder.path() / "export/changes.ply").points.size(), 5000U);
  for (const char* name : {"map.yaml", "map.pgm", "map.bt"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "export" / name)) << name;
  }
  EXPECT_GT(read_trajectory_tum(folder.path() / "export/session_1.tum").size(), 3U);
  expect_success(
      run_mms(folder.path(), {"map", "export", "one.mmsmap", "-o", "export", "--overwrite"}));
  for (const char* name : {"changes.ply", "session_1.tum"}) {  // of the other map
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "export" / name)) << name;
  }
}

TEST(Map, APlaceOfASessionOutsideTheMapIsNoPlaceOfTheMap) {
  const TempFolder folder;
  expect_success(
      run_day(folder, "sim:static?width=320&hz=3&frames=6", "other", {"--save-map", "a.mmsmap"}));
  expect_success(run_day(folder, kFirstDay, "first", {"--map", "a.mmsmap"}));
  const Outcome second = run_day(folder, kSecondDay, "second", {"--map", "a.mmsmap"});
  expect_success(second);
  EXPECT_GT(loops_of(folder, "second")["earlier_map"]["closed"], 0);
  EXPECT_TRUE(loops_of(folder, "second")["earlier_map"]["localized_s"].is_null());
  EXPECT_NE(second.err.find("frame of their own"), std::string::npos) << second.err;
}

TEST(Map, ExportHasTheSettingsOfTheRun) {
  const TempFolder folder;
  expect_success(run_day(folder, kFirstDay, "first",
                         {"--save-map", "a.mmsmap", "--set", "occupancy.voxel_size=0.25"}));
  expect_success(run_mms(folder.path(), {"map", "export", "a.mmsmap", "-o", "export"}));
  EXPECT_NE(read_file(folder.path() / "export/map.yaml").find("resolution: 0.25"),
            std::string::npos);
}

TEST(Map, AfterALossInAnUnknownPlaceTheNewSessionIsWrittenToo) {
  const TempFolder folder;
  const Outcome run = run_day(
      folder, "sim:warehouse_loop?start=17&dark_from=1.5&dark_for=3&hz=10&width=320&duration=9.5",
      "out", {"--save-map", "a.mmsmap", "--keep-journal"});
  expect_success(run);
  EXPECT_NE(run.err.find("session 1 begins"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("session 1 has no place in the map"), std::string::npos) << run.err;
  const nlohmann::json sessions = loops_of(folder, "out")["sessions"];
  EXPECT_EQ(sessions["begun"], 2);
  EXPECT_EQ(sessions["in_map"], 1);
  const std::filesystem::path out = folder.path() / "out";
  const std::size_t frames = read_trajectory_tum(out / "trajectory.tum").size();
  const std::size_t in_map = read_trajectory_tum(out / "trajectory_map.tum").size();
  EXPECT_EQ(frames, 95U);
  EXPECT_EQ(sessions["frames_outside"], frames - in_map);
  const Trajectory outside = read_trajectory_tum(out / "outside_map/session_1.tum");
  EXPECT_GT(outside.size(), 10U);
  EXPECT_LT(outside.size() + in_map, frames) << "the lost frames have no place";
  const std::size_t first = read_ply(out / "static_map.ply").points.size();
  const std::size_t second = read_ply(out / "outside_map/session_1.ply").points.size();
  EXPECT_GT(second, 10000U);

  const Outcome info = run_mms(folder.path(), {"info", "a.mmsmap"});
  EXPECT_NE(info.out.find("2 sessions"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("not joined to session 0"), std::string::npos) << info.out;
  expect_success(run_mms(folder.path(), {"map", "check", "a.mmsmap"}));

  // The journal has the maps of both.
  std::filesystem::create_directory(folder.path() / "killed");
  std::filesystem::rename(out / "journal.bin", folder.path() / "killed/journal.bin");
  expect_success(run_mms(folder.path(), {"convert", "killed"}));
  EXPECT_EQ(read_ply(folder.path() / "killed/static_map.ply").points.size(), first + second);
}

TEST(Map, MergeTakesTheMapsInAnyOrder) {
  const TempFolder folder;
  expect_success(run_day(folder, kFirstDay, "first", {"--save-map", "a.mmsmap"}));
  expect_success(run_day(folder, kSecondDay, "second", {"--save-map", "b.mmsmap"}));
  for (const std::vector<std::string>& order :
       {std::vector<std::string>{"a.mmsmap", "b.mmsmap"}, {"b.mmsmap", "a.mmsmap"}}) {
    const std::string name = order[0].substr(0, 1);
    const Outcome merged =
        run_mms(folder.path(), {"merge", order[0], order[1], "-o", name + "_merged.mmsmap"});
    expect_success(merged);
    EXPECT_NE(merged.out.find("2 of 2 sessions joined"), std::string::npos) << merged.out;
    expect_success(
        run_mms(folder.path(), {"map", "export", name + "_merged.mmsmap", "-o", name + "_out"}));
  }
  EXPECT_EQ(read_file(folder.path() / "a_out/static_map.ply"),
            read_file(folder.path() / "b_out/static_map.ply"));
}

TEST(Map, LidarScansHaveMapsThatMixWithNoImages) {
  const TempFolder folder;
  const std::string scans = "sim:warehouse_loop?sensor=lidar16&hz=5&frames=10";
  expect_success(run_day(folder, scans, "first", {"--save-map", "a.mmsmap"}));
  const Outcome info = run_mms(folder.path(), {"info", "a.mmsmap"});
  EXPECT_NE(info.out.find("LiDAR"), std::string::npos) << info.out;
  expect_success(run_mms(folder.path(), {"map", "check", "a.mmsmap"}));
  expect_success(run_mms(folder.path(), {"map", "export", "a.mmsmap", "-o", "export"}));
  EXPECT_GT(read_ply(folder.path() / "export/static_map.ply").points.size(), 5000U);
  expect_success(run_day(folder, scans, "second", {"--map", "a.mmsmap", "--localise"}));
  EXPECT_GT(loops_of(folder, "second")["earlier_map"]["keyframes"], 0);

  const Outcome other = run_day(folder, kFirstDay, "refused", {"--map", "a.mmsmap"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("is a map of LiDAR scans"), std::string::npos) << other.err;
  expect_success(run_day(folder, kFirstDay, "images", {"--save-map", "d.mmsmap"}));
  const Outcome mixed = run_mms(folder.path(), {"merge", "a.mmsmap", "d.mmsmap", "-o", "e.mmsmap"});
  EXPECT_EQ(mixed.exit_code, 1);
  EXPECT_NE(mixed.err.find("is a map of depth images"), std::string::npos) << mixed.err;
}

TEST(Map, WrongOptionsAndFilesAreRefused) {
  const TempFolder folder;
  expect_success(run_day(folder, kFirstDay, "first", {"--save-map", "a.mmsmap"}));
  const auto refused = [&](const std::vector<std::string>& more, const std::string& words,
                           const std::string& day = kFirstDay) {
    const Outcome outcome = run_day(folder, day, "refused", more);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  };
  refused({"--save-map", "a.mmsmap"}, "--map FILE goes on in it");
  refused({"--localize"}, "needs a map");
  refused({"--map", "missing.mmsmap"}, "does not exist");
  refused({"--map", "first/metrics.json"}, "is no map");
  refused({"--map", "a.mmsmap", "--loops", "off"}, "needs loop closure");
  refused({"--map", "a.mmsmap", "--localize", "--save-map", "b.mmsmap"}, "does not go with");
  refused({"--save-map", "missing/b.mmsmap"}, "folder does not exist");
  refused({"--map", "a.mmsmap"}, "is a map of depth images, but the recording has LiDAR scans",
          "sim:static?sensor=lidar16&frames=3");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.mmsmap.partial"));
}

}  // namespace
}  // namespace mms
