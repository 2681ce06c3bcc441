#include <gtest/gtest.h>
#include <octomap/OcTree.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

Outcome run_scene(const TempFolder& folder, const std::vector<std::string>& more = {}) {
  write_scene(folder.path() / "data", small_scene(6));
  std::vector<std::string> arguments = {"run", "data", "-o", "out", "--segmenter", "masks"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_mms(folder.path(), arguments);
}

/// Pixels of the PGM with that value.
std::ptrdiff_t pixels(const std::string& pgm, int value) {
  const std::size_t header = pgm.find("\n255\n") + 5;
  return std::count(pgm.begin() + static_cast<std::ptrdiff_t>(header), pgm.end(),
                    static_cast<char>(value));
}

TEST(RobotMaps, RunWritesValidGridAndOctomap) {
  const TempFolder folder;
  const Outcome outcome = run_scene(folder);
  expect_success(outcome);
  EXPECT_EQ(lines_with(outcome, "no floor"), 0) << outcome.err;
  const YAML::Node yaml = YAML::LoadFile((folder.path() / "out/map.yaml").string());
  EXPECT_EQ(yaml["image"].as<std::string>(), "map.pgm");
  EXPECT_EQ(yaml["resolution"].as<double>(), 0.1);
  const std::string pgm = read_file(folder.path() / "out/map.pgm");
  EXPECT_EQ(pgm.substr(0, 3), "P5\n");
  EXPECT_GT(pixels(pgm, 254), 100);  // free
  EXPECT_GT(pixels(pgm, 0), 10);     // occupied
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary((folder.path() / "out/map.bt").string()));
  EXPECT_DOUBLE_EQ(tree.getResolution(), 0.1);
  EXPECT_GT(tree.getNumLeafNodes(), 500U);
}

TEST(RobotMaps, WritesNoneWhenDisabled) {
  const TempFolder folder;
  folder.write("off.yaml", "occupancy: {enabled: false}\n");
  expect_success(run_scene(folder, {"-c", "off.yaml"}));
  EXPECT_TRUE(fs::exists(folder.path() / "out/static_map.ply"));
  for (const char* file : {"map.pgm", "map.yaml", "map.bt"}) {
    EXPECT_FALSE(fs::exists(folder.path() / "out" / file)) << file;
  }
}

TEST(RobotMaps, WarnsWithoutFloor) {
  const TempFolder folder;
  folder.write("large.yaml", "occupancy: {floor: {min_area: 10000}}\n");
  const Outcome outcome = run_scene(folder, {"-c", "large.yaml"});
  expect_success(outcome);
  EXPECT_EQ(lines_with(outcome, "warning: no floor of 10000 m^2 found"), 1) << outcome.err;
  EXPECT_TRUE(fs::exists(folder.path() / "out/map.yaml"));
}

}  // namespace
}  // namespace mms
