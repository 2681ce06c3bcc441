#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>

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
  const std::string expected = trajectory_of("tum", "masks");
  expect_success(run({"convert", "x.bag", "-o", "x.mcap"}));
  EXPECT_EQ(trajectory_of("x.bag", "masks"), expected);
  EXPECT_EQ(trajectory_of("x.mcap", "masks"), expected);
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
  folder_.write("cut.bag", whole.substr(0, 8000));
  folder_.write("empty.bag", "");
  expect_error(run({"run", "cut.bag"}), "cut.bag: is damaged or truncated at byte 4117 of 8000");
  expect_error(run({"run", "empty.bag"}), "empty.bag: is empty");
  expect_error(run({"run", "x.bag", "--topic-depth", "/d"}),
               "--topic-depth is /d, which is missing");
  expect_error(run({"run", "tum", "--topic-depth", "/d"}), "is not a bag");
  expect_error(run({"convert", "sim:crowd?frames=1"}), "use -o x.bag or x.mcap");
}

TEST_F(BagCommands, ReadsCutBagsUpToTheCut) {
  for (const std::string name : {"cut.bag", "cut.mcap"}) {
    const std::string whole_name = "whole" + name.substr(3);
    expect_success(run({"convert", "tum", "-o", whole_name}));
    const std::string whole = read_file(path(whole_name));
    folder_.write(name, whole.substr(0, whole.size() * 3 / 4));
    const Outcome outcome = run({"run", name, "--segmenter", "none", "-o", "o", "--overwrite"});
    expect_success(outcome);
    expect_in("warning: " + name + ": is damaged or truncated at byte ", outcome.err);
    const std::string frames = read_file(path("o/trajectory.tum"));
    EXPECT_GE(std::count(frames.begin(), frames.end(), '\n'), 3);
  }
}

TEST_F(BagCommands, ConvertsFoldersOfRosbag2) {
  expect_success(run({"convert", "tum", "-o", "x.mcap"}));
  fs::create_directory(path("split"));
  fs::rename(path("x.mcap"), path("split/split_0.mcap"));
  folder_.write("split/metadata.yaml",
                "rosbag2_bagfile_information:\n  relative_file_paths: [split_0.mcap]\n");
  expect_in("layout: MCAP", run({"info", "split"}).out);
  expect_success(run({"convert", "split", "-o", "back"}));
  EXPECT_EQ(trajectory_of("back", "masks"), trajectory_of("tum", "masks"));
}

TEST_F(BagCommands, FullDiskIsOneError) {
  for (const std::string name : {"full.bag", "full.mcap"}) {
    // Writing fails beyond 50 kB, as on a full disk.
    const std::string command = "cd " + folder_.path().string() +
                                " && trap '' XFSZ; ulimit -f 50; " + MMS_PROGRAM +
                                " convert tum -o " + name + " 2> err";
    const int status = std::system(command.c_str());  // NOLINT: the limit needs a shell
    EXPECT_EQ(WEXITSTATUS(status), 1);
    const std::string partial = std::string(name).insert(name.find('.'), ".partial");
    expect_in(partial + ": cannot be written: File too large", read_file(path("err")));
    for (const std::string& left : list_folder(folder_.path())) {
      EXPECT_EQ(left.find("full"), std::string::npos) << left;
    }
  }
}

TEST_F(BagCommands, ConvertsSimulationsToBags) {
  expect_success(run({"convert", "sim:crowd?frames=2&width=64", "-o", "s.bag"}));
  expect_in("frames: 2", run({"info", "s.bag"}).out);
}

}  // namespace
}  // namespace mms
