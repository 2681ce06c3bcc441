#include "mms/io/results/trajectory_io.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

Trajectory random_trajectory() {
  std::srand(3);
  Trajectory trajectory;
  for (std::int64_t i = 0; i < 20; ++i) {
    const Vector6d tangent = 3.0 * Vector6d::Random();
    trajectory.push_back({Timestamp(1305031102175304123 + i * 33'333'333),
                          Transform<World, Sensor>(se3::exp(tangent))});
  }
  return trajectory;
}

TEST(TrajectoryTum, RoundTrips) {
  const TempFolder folder;
  const auto path = folder.path() / "trajectory.tum";
  const Trajectory written = random_trajectory();
  write_trajectory_tum(path, written);
  const Trajectory read = read_trajectory_tum(path);
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp, written[i].stamp);
    EXPECT_EQ(read[i].T_world_sensor.translation(), written[i].T_world_sensor.translation());
    EXPECT_TRUE(
        read[i].T_world_sensor.rotation().isApprox(written[i].T_world_sensor.rotation(), 1e-14));
  }
}

TEST(TrajectoryTum, StampsHaveNineDecimals) {
  const TempFolder folder;
  const auto path = folder.path() / "trajectory.tum";
  write_trajectory_tum(path, {{Timestamp(1'500'000'000), {}}});
  EXPECT_EQ(read_file(path), "# stamp tx ty tz qx qy qz qw\n1.500000000 0 0 0 0 0 0 1\n");
}

TEST(TrajectoryTum, NormalisesQuaternions) {
  const TempFolder folder;
  const auto read = read_trajectory_tum(folder.write("t", "0 1 2 3 0 0 2 2\n"));
  EXPECT_TRUE(read[0].T_world_sensor.rotation().isUnitary(1e-15));
  EXPECT_NEAR(read[0].T_world_sensor.rotation()(1, 0), 1.0, 1e-15);
}

TEST(TrajectoryTum, ReadsQuaternionsOfEuroc) {
  const TempFolder folder;
  const std::string header =
      "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], "
      "q_RS_y [], q_RS_z []";
  folder.write("tum_vi.csv", header + "\n1520530308199447626,1,2,3,1,0,0,0\n");
  folder.write("euroc.csv", header + ", v_RS_R_x [m s^-1]\n1520530308199447626,1,2,3,1,0,0,0,9\n");
  for (const char* name : {"tum_vi.csv", "euroc.csv"}) {
    const Trajectory poses = read_trajectory_tum(folder.path() / name);
    ASSERT_EQ(poses.size(), 1U);
    EXPECT_EQ(poses[0].stamp, Timestamp(1520530308199447626));
    EXPECT_EQ(poses[0].T_world_sensor.translation(), Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(poses[0].T_world_sensor.rotation().isIdentity(1e-12));
  }
}

TEST(TrajectoryTum, ErrorsNameFileAndLine) {
  const TempFolder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"1 2 3\n", "3 columns, expected 8: stamp tx ty tz qx qy qz qw"},
      {"x 0 0 0 0 0 0 1\n", "'x' is not a stamp"},
      {"1 0 0 nan 0 0 0 1\n", "'nan' is not a finite number"},
      {"1 0 0 0.1.2 0 0 0 1\n", "'0.1.2' is not a finite number"},
      {"1 0 0 0 0 0 0 0\n", "the quaternion is zero"},
  };
  for (const auto& [line, expected] : cases) {
    const auto path = folder.write("t.txt", std::string("# head\n0 0 0 0 0 0 0 1\n") + line);
    expect_in(path.string() + ":3: " + expected,
              message_of<DataError>([&] { read_trajectory_tum(path); }));
  }
  const auto empty = folder.write("t.txt", "# nothing\n");
  expect_in("has no poses", message_of<DataError>([&] { read_trajectory_tum(empty); }));
  expect_in("no such file",
            message_of<FileError>([&] { read_trajectory_tum(folder.path() / "missing.txt"); }));
}

TEST(TrajectoryKitti, RoundTripsExactly) {
  const TempFolder folder;
  const auto path = folder.path() / "poses.txt";
  const Trajectory written = random_trajectory();
  std::vector<Timestamp> stamps;
  for (const StampedPose& pose : written) stamps.push_back(pose.stamp);
  write_trajectory_kitti(path, written);
  const Trajectory read = read_trajectory_kitti(path, stamps);
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp, written[i].stamp);
    EXPECT_EQ(read[i].T_world_sensor.isometry().matrix(),
              written[i].T_world_sensor.isometry().matrix());
  }
  EXPECT_EQ(read_trajectory_kitti(path)[7].stamp, Timestamp(700'000'000));
}

TEST(TrajectoryKitti, ErrorsNameFileAndLine) {
  const TempFolder folder;
  const auto scaled = folder.write("p.txt", "2 0 0 0 0 2 0 0 0 0 2 0\n");
  expect_in(scaled.string() + ":1: the 3x3 part is not a rotation",
            message_of<DataError>([&] { read_trajectory_kitti(scaled); }));
  const auto mirrored = folder.write("p.txt", "-1 0 0 0 0 1 0 0 0 0 1 0\n");
  message_of<DataError>([&] { read_trajectory_kitti(mirrored); });
  const auto valid = folder.write("p.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const Timestamp stamps[2];
  expect_in("1 poses and 2 stamps",
            message_of<DataError>([&] { read_trajectory_kitti(valid, stamps); }));
}

TEST(Trajectory, DetectsFormatFromColumns) {
  const TempFolder folder;
  EXPECT_EQ(read_trajectory(folder.write("a", "1 0 0 0 0 1 0 0 0 0 1 5\n"))[0]
                .T_world_sensor.translation()
                .z(),
            5.0);
  EXPECT_EQ(read_trajectory(folder.write("b", "1 0 0 5 0 0 0 1\n"))[0].stamp,
            Timestamp(1'000'000'000));
  const auto other = folder.write("c", "1 2 3 4\n");
  expect_in("expected 8", message_of<DataError>([&] { read_trajectory(other); }));
}

TEST(Trajectory, ErrorNamesUnwritableFile) {
  expect_in("/no/such/t.txt: cannot be written",
            message_of<FileError>([] { write_trajectory_tum("/no/such/t.txt", {}); }));
}

TEST(Trajectory, ReadsBenchmarkFiles) {
  const std::filesystem::path shared =
      std::filesystem::path(MMS_SOURCE_DIR) / "../shared/data/trajectories";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no shared data";
  EXPECT_EQ(read_trajectory(shared / "KITTI_00_gt.txt").size(), 4541U);
  EXPECT_EQ(read_trajectory(shared / "KITTI_00_ORB.txt").size(), 4541U);
  EXPECT_GT(read_trajectory(shared / "freiburg1_xyz-groundtruth.txt").size(), 785U);
  EXPECT_GT(read_trajectory(shared / "fr3_walking_xyz-estimate.txt").size(), 800U);
}

}  // namespace
}  // namespace mms
