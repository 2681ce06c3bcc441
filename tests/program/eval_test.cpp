#include <gtest/gtest.h>

#include "mms/io/ply_io.hpp"
#include "mms/io/trajectory_io.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using Keys = std::set<std::string>;

const std::string kWay =
    "1.0 0 0 0 0 0 0 1\n1.5 0.1 0 0 0 0 0 1\n2.0 0.2 0.1 0 0 0 0 1\n2.5 0.3 0.2 0.1 0 0 0 1\n";

nlohmann::json json_of(const Outcome& outcome) {
  expect_done(outcome);
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1) << outcome.out;
  return nlohmann::json::parse(outcome.out, nullptr, false);
}

TEST(EvalTrajectory, OfTheSamePosesIsZero) {
  const TempFolder folder;
  folder.write("a.tum", kWay);
  const auto json =
      json_of(run_mms(folder.path(), {"eval", "trajectory", "a.tum", "a.tum", "--json"}));
  EXPECT_EQ(keys_of(json), (Keys{"matched", "poses", "ate_rmse_m", "ate_mean_m", "ate_median_m",
                                 "ate_max_m", "rpe_trans_rmse_m", "rpe_rot_rmse_deg"}));
  EXPECT_EQ(json["matched"], 4);
  EXPECT_NEAR(json["ate_rmse_m"], 0.0, 1e-12);
  EXPECT_NEAR(json["rpe_trans_rmse_m"], 0.0, 1e-12);
}

TEST(EvalTrajectory, TheTableSaysHowManyMatched) {
  const TempFolder folder;
  folder.write("a.tum", kWay);
  folder.write("b.tum", kWay + "9.0 0 0 0 0 0 0 1\n");
  const Outcome outcome = run_mms(folder.path(), {"eval", "trajectory", "a.tum", "b.tum"});
  expect_done(outcome);
  expect_in("matched 4 of 5 poses within 0.02 s", outcome.out);
}

TEST(EvalTrajectory, FaultsAreOneLine) {
  const TempFolder folder;
  folder.write("a.tum", kWay);
  folder.write("late.tum", "91 0 0 0 0 0 0 1\n92 0 0 0 0 0 0 1\n93 0 0 0 0 0 0 1\n");
  folder.write("garbled.tum", "1.0 0 0 0 0 0 0 1\n1.5 0 zero 0 0 0 0 1\n");
  folder.write("kitti.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  folder.write("empty.tum", "# nothing\n");
  const auto run = [&](const std::string& estimate) {
    return run_mms(folder.path(), {"eval", "trajectory", "a.tum", estimate});
  };
  expect_fault(run("missing.tum"), "missing.tum: ");
  expect_fault(run("late.tum"), "0 of 3 estimated poses match");
  expect_fault(run("garbled.tum"), "garbled.tum:2: ");
  expect_fault(run("kitti.txt"), "kitti.txt: is of another form than a.tum");
  expect_fault(run("empty.tum"), "empty.tum: ");
}

TEST(EvalDrift, IsTheDistanceFromTheFirstPose) {
  const TempFolder folder;
  folder.write("a.tum", "1 1 0 0 0 0 0 1\n2 1.01 0 0 0 0 0 1\n3 1 0.03 0 0 0 0 1\n");
  const auto json = json_of(run_mms(folder.path(), {"eval", "drift", "a.tum", "--json"}));
  EXPECT_EQ(keys_of(json), (Keys{"poses", "atde_cm", "mtde_cm"}));
  EXPECT_EQ(json["poses"], 3);
  EXPECT_NEAR(json["mtde_cm"], 3.0, 1e-9);
  expect_fault(run_mms(folder.path(), {"eval", "drift", "missing.tum"}), "missing.tum: ");
}

PointCloudFile points_at(const std::vector<Eigen::Vector3f>& points) {
  PointCloudFile file;
  file.points = points;
  return file;
}

TEST(EvalMap, CountsWhatIsThereAndWhatIsGone) {
  const TempFolder folder;
  PointCloudFile truth = points_at({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  truth.labels = {0, 0, 1, 1};
  write_ply(folder.path() / "truth.ply", truth);
  write_ply(folder.path() / "map.ply", points_at({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  const auto json =
      json_of(run_mms(folder.path(), {"eval", "map", "truth.ply", "map.ply", "--json"}));
  EXPECT_EQ(keys_of(json), (Keys{"SA", "DA", "AA", "HA"}));
  EXPECT_NEAR(json["SA"], 100.0, 1e-9);
  EXPECT_NEAR(json["DA"], 50.0, 1e-9);
}

TEST(EvalMap, FaultsAreOneLine) {
  const TempFolder folder;
  write_ply(folder.path() / "map.ply", points_at({{0, 0, 0}}));
  folder.write("bad.ply", "no ply at all\n");
  expect_fault(run_mms(folder.path(), {"eval", "map", "map.ply", "map.ply"}),
               "map.ply: has no property 'label'");
  expect_fault(run_mms(folder.path(), {"eval", "map", "bad.ply", "map.ply"}), "bad.ply");
  expect_fault(run_mms(folder.path(), {"eval", "map", "none.ply", "map.ply"}), "none.ply: ");
}

TEST(EvalResidue, OfTheScenesOwnMapIsSmall) {
  const TempFolder folder;
  const std::string still = "sim:corridor?ride=still&crossing=1&width=320&frames=12";
  expect_done(run_mms(folder.path(), {"run", still, "-o", "out"}));
  const auto json =
      json_of(run_mms(folder.path(), {"eval", "residue", still, "out/static_map.ply", "--json"}));
  EXPECT_EQ(keys_of(json), (Keys{"points", "seen", "residue", "residue_percent"}));
  EXPECT_GT(json["seen"], 4000);
  EXPECT_LT(json["residue_percent"], 1.0);
}

TEST(EvalResidue, FaultsAreOneLine) {
  const TempFolder folder;
  write_hall(folder.path() / "hall", 1);
  write_ply(folder.path() / "map.ply", points_at({{0, 0, 0}}));
  expect_fault(run_mms(folder.path(), {"eval", "residue", "hall", "map.ply"}),
               "hall: has no depth images");
  expect_fault(run_mms(folder.path(), {"eval", "residue", "nowhere", "map.ply"}), "nowhere: ");
}

/// The reference implementations' values for the shared trajectories.
struct Gold {
  std::string reference;
  std::string estimate;
  std::vector<std::string> more;
  int matched;
  double rmse;
  double mean;
  double median;
  double max;
};

void expect_gold(const Gold& gold) {
  const fs::path shared = fs::path(MMS_SOURCE_DIR) / "../shared/data/trajectories";
  if (!fs::exists(shared)) GTEST_SKIP() << "no shared data in ../shared/data";
  const TempFolder folder;
  std::vector<std::string> arguments = {"eval", "trajectory", shared / gold.reference,
                                        shared / gold.estimate, "--json"};
  arguments.insert(arguments.end(), gold.more.begin(), gold.more.end());
  const auto json = json_of(run_mms(folder.path(), arguments));
  EXPECT_EQ(json["matched"], gold.matched);
  EXPECT_NEAR(json["ate_rmse_m"], gold.rmse, 1e-6);
  EXPECT_NEAR(json["ate_mean_m"], gold.mean, 1e-6);
  EXPECT_NEAR(json["ate_median_m"], gold.median, 1e-6);
  EXPECT_NEAR(json["ate_max_m"], gold.max, 1e-6);
}

TEST(EvalGold, Kitti00) {
  expect_gold({"KITTI_00_gt.txt",
               "KITTI_00_ORB.txt",
               {},
               4541,
               1.303449715,
               1.156997129,
               1.065624770,
               3.587949121});
}

TEST(EvalGold, Freiburg1Xyz) {
  expect_gold({"freiburg1_xyz-groundtruth.txt",
               "freiburg1_xyz-rgbdslam_drift.txt",
               {"--max-difference", "0.01"},
               785,
               0.013470119,
               0.012024516,
               0.011183138,
               0.034759897});
}

TEST(EvalGold, Freiburg3WalkingXyz) {
  expect_gold({"fr3_walking_xyz-groundtruth.txt",
               "fr3_walking_xyz-estimate.txt",
               {},
               826,
               0.015881181,
               0.013790642,
               0.012320494,
               0.057617119});
}

}  // namespace
}  // namespace mms
