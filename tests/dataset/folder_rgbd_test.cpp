#include "mms/dataset/folder/folder_rgbd.hpp"

#include <gtest/gtest.h>

#include "mms/dataset/open_dataset.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

void write_frame(const TempFolder& folder, const std::string& name, std::uint16_t depth) {
  write_color(folder.path() / (name + ".color.png"));
  write_depth(folder.path() / (name + ".depth.png"), depth);
  folder.write(name + ".pose.txt", "1 0 0 0.5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
}

TEST(FolderRgbd, ReadsFramesAndPoses) {
  const TempFolder folder;
  folder.write("calibration.yaml", kCalibration);
  write_frame(folder, "frame-000000", 2000);
  write_frame(folder, "frame-000001", 65535);
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.names(), "frame-000000 frame-000001");
  EXPECT_EQ(played.frames[0].depth(0, 0), 2.0F);
  EXPECT_EQ(played.frames[1].depth(0, 0), 0.0F);
  EXPECT_EQ(played.frames[1].stamp, Timestamp(33'333'333));
  ASSERT_EQ(played.source->ground_truth().size(), 2U);
  EXPECT_EQ(played.source->ground_truth()[1].stamp, played.frames[1].stamp);
  EXPECT_EQ(played.source->ground_truth()[1].T_world_sensor.translation().x(), 0.5);
}

TEST(FolderRgbd, UsesSevenScenesCameraByDefault) {
  const TempFolder folder;
  write_frame(folder, "frame-000000", 2000);
  const auto lines = open_dataset(folder.path())->describe();
  EXPECT_TRUE(any_has(lines, "default of 7-Scenes"));
  EXPECT_TRUE(any_has(lines, "640x480"));
}

TEST(FolderRgbd, SkipsAndReportsMissingDepthAndPoses) {
  const TempFolder folder;
  folder.write("calibration.yaml", kCalibration);
  write_frame(folder, "a", 1000);
  write_frame(folder, "b", 1000);
  std::filesystem::remove(folder.path() / "a.depth.png");
  folder.write("b.pose.txt", "-1.#IND 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "b");
  EXPECT_EQ(played.source->ground_truth().size(), 1U);
  EXPECT_TRUE(any_has(played.warnings, "frame a skipped: "));
  EXPECT_TRUE(any_has(played.warnings, "pose skipped: "));
}

}  // namespace
}  // namespace mms
