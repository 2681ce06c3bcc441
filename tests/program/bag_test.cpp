#include <gtest/gtest.h>

#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

class BagCommands : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!MMS_WITH_ROSBAG) GTEST_SKIP() << "librosbag-storage-dev is not installed";
    write_scene(path("tum"), small_scene(8));
    expect_success(run({"convert", "tum", "-o", "x.bag"}));
  }

  fs::path path(const std::string& name) const { return folder_.path() / name; }
  Outcome run(const std::vector<std::string>& words) const {
    return run_mms(folder_.path(), words);
  }
  std::string trajectory_of(const std::string& data, const std::string& segmenter) const {
    expect_success(run({"run", data, "--segmenter", segmenter, "-o", "results", "--overwrite"}));
    return read_file(path("results/trajectory.tum"));
  }

  TempFolder folder_;
};

TEST_F(BagCommands, BagGivesSameTrajectoryAsFolder) {
  EXPECT_EQ(trajectory_of("x.bag", "masks"), trajectory_of("tum", "masks"));
  EXPECT_TRUE(json_file(path("results/metrics.json")).contains("trajectory"));
}

TEST_F(BagCommands, InfoListsAllAndChosenTopics) {
  const Outcome outcome = run({"info", "x.bag"});
  expect_success(outcome);
  expect_in("layout: ROS 1 bag", outcome.out);
  expect_in("topic: /camera/color/image_raw, sensor_msgs/Image, 8 messages", outcome.out);
  expect_in("color topic: /camera/color/image_raw", outcome.out);
  expect_in("frame 7: readable", outcome.out);
}

TEST_F(BagCommands, ConvertsToFolderAndBack) {
  const Outcome outcome = run({"convert", "x.bag"});
  expect_success(outcome);
  expect_in("x: 8 frames, 8 ground-truth poses", outcome.out);
  EXPECT_EQ(trajectory_of("x", "masks"), trajectory_of("tum", "masks"));
  expect_error(run({"convert", "x.bag"}), "x: is not empty");
}

TEST_F(BagCommands, CompressedBagsAreSmaller) {
  expect_success(run({"convert", "x.bag", "-o", "small.bag", "--compressed"}));
  EXPECT_LT(2 * fs::file_size(path("small.bag")), fs::file_size(path("x.bag")));
  expect_success(run({"run", "small.bag", "--segmenter", "none", "--frames", "3"}));
  expect_error(run({"convert", "tum", "-o", "small.bag"}),
               "small.bag: exists already (replace it with --overwrite)");
  expect_success(run({"convert", "tum", "-o", "small.bag", "--overwrite"}));
}

TEST_F(BagCommands, ErrorsOfBadBagsAreOneLine) {
  const std::string whole = read_file(path("x.bag"));
  folder_.write("cut.bag", whole.substr(0, whole.size() / 2));
  folder_.write("empty.bag", "");
  expect_error(run({"run", "cut.bag"}), "cut.bag: is truncated: it has /camera/");
  expect_error(run({"run", "empty.bag"}), "empty.bag: is empty");
  expect_error(run({"run", "x.bag", "--topic-depth", "/d"}),
               "--topic-depth is /d, which is missing");
  expect_error(run({"run", "tum", "--topic-depth", "/d"}), "is not a bag");
  expect_error(run({"convert", "sim:crowd?frames=1"}), "use -o x.bag");
}

TEST_F(BagCommands, ConvertsSimulationsToBags) {
  expect_success(run({"convert", "sim:crowd?frames=2&width=64", "-o", "s.bag"}));
  expect_in("frames: 2", run({"info", "s.bag"}).out);
}

}  // namespace
}  // namespace mms
