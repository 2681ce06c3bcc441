#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <sstream>

#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/image/coco_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using Keys = std::set<std::string>;

const std::string kTrajectory =
    "1.0 0 0 0 0 0 0 1\n1.5 0.1 0 0 0 0 0 1\n2.0 0.2 0.1 0 0 0 0 1\n2.5 0.3 0.2 0.1 0 0 0 1\n";

nlohmann::json json_of(const Outcome& outcome) {
  expect_success(outcome);
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1) << outcome.out;
  return nlohmann::json::parse(outcome.out, nullptr, false);
}

TEST(EvalTrajectory, IsZeroForSamePoses) {
  const TempFolder folder;
  folder.write("a.tum", kTrajectory);
  const auto json =
      json_of(run_mms(folder.path(), {"eval", "trajectory", "a.tum", "a.tum", "--json"}));
  EXPECT_EQ(keys_of(json),
            (Keys{"matched", "poses", "path_m", "ate_rmse_m", "ate_mean_m", "ate_median_m",
                  "ate_max_m", "rpe_trans_rmse_m", "rpe_rot_rmse_deg"}));
  EXPECT_EQ(json["matched"], 4);
  EXPECT_NEAR(json["ate_rmse_m"], 0.0, 1e-12);
  EXPECT_NEAR(json["rpe_trans_rmse_m"], 0.0, 1e-12);
}

TEST(EvalTrajectory, TableNamesNumberOfMatches) {
  const TempFolder folder;
  folder.write("a.tum", kTrajectory);
  folder.write("b.tum", kTrajectory + "9.0 0 0 0 0 0 0 1\n");
  const Outcome outcome = run_mms(folder.path(), {"eval", "trajectory", "a.tum", "b.tum"});
  expect_success(outcome);
  expect_in("matched 4 of 5 poses within 0.02 s", outcome.out);
}

/// Poses of a car that turns left, in the frame of its first pose; `T` maps them to another sensor.
std::string kitti_poses(int count, const Eigen::Isometry3d& T) {
  std::ostringstream text;
  text.precision(12);
  for (int i = 0; i < count; ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.rotate(Eigen::AngleAxisd(0.02 * i, Eigen::Vector3d::UnitZ()));
    pose.translation() = Eigen::Vector3d(i, 0.01 * i * i, 0);
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows =
        (T * pose * T.inverse()).matrix().topRows<3>();
    for (int k = 0; k < 12; ++k) text << rows.data()[k] << ' ';
    text << '\n';
  }
  return text.str();
}

TEST(EvalTrajectory, ConvertsPosesOfKittiLidar) {
  Eigen::Isometry3d T_camera_lidar = Eigen::Isometry3d::Identity();
  T_camera_lidar.matrix().topRows<3>() << 0, -1, 0, 0, 0, 0, -1, -0.1, 1, 0, 0, -0.3;
  const TempFolder folder;
  folder.write("calib.txt",
               "P2: 700 0 600 0 0 700 180 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 -0.1 1 0 0 -0.3\n");
  folder.write("lidar.txt", kitti_poses(30, Eigen::Isometry3d::Identity()));
  folder.write("camera.txt", kitti_poses(30, T_camera_lidar));
  const std::vector<std::string> command = {"eval", "trajectory", "camera.txt", "lidar.txt",
                                            "--json"};
  EXPECT_GT(json_of(run_mms(folder.path(), command))["rpe_trans_rmse_m"], 1.0);
  auto converted = command;
  converted.insert(converted.end(), {"--kitti-calib", "calib.txt"});
  EXPECT_LT(json_of(run_mms(folder.path(), converted))["rpe_trans_rmse_m"], 1e-6);
}

TEST(EvalTrajectory, WarnsOfOtherAxes) {
  Eigen::Isometry3d T_camera_lidar = Eigen::Isometry3d::Identity();
  T_camera_lidar.matrix().topRows<3>() << 0, -1, 0, 0, 0, 0, -1, -0.1, 1, 0, 0, -0.3;
  const TempFolder folder;
  folder.write("lidar.txt", kitti_poses(150, Eigen::Isometry3d::Identity()));
  folder.write("camera.txt", kitti_poses(150, T_camera_lidar));
  const std::string text = "lidar.txt moves along other axes than camera.txt";
  const auto outcome = run_mms(folder.path(), {"eval", "trajectory", "camera.txt", "lidar.txt"});
  expect_success(outcome);
  expect_in(text, outcome.err);
  expect_in("--kitti-calib", outcome.err);
  const auto same = run_mms(folder.path(), {"eval", "trajectory", "lidar.txt", "lidar.txt"});
  expect_success(same);
  EXPECT_EQ(same.err.find("axes"), std::string::npos) << same.err;
}

TEST(EvalTrajectory, WarnsOfKittiFilesOfOtherLengths) {
  const TempFolder folder;
  folder.write("a.txt", kitti_poses(30, Eigen::Isometry3d::Identity()));
  folder.write("b.txt", kitti_poses(29, Eigen::Isometry3d::Identity()));
  const Outcome outcome = run_mms(folder.path(), {"eval", "trajectory", "a.txt", "b.txt"});
  expect_success(outcome);
  expect_in("a.txt has 30 poses, b.txt has 29", outcome.err);
}

TEST(EvalTrajectory, ErrorsAreOneLine) {
  const TempFolder folder;
  folder.write("a.tum", kTrajectory);
  folder.write("late.tum", "91 0 0 0 0 0 0 1\n92 0 0 0 0 0 0 1\n93 0 0 0 0 0 0 1\n");
  folder.write("garbled.tum", "1.0 0 0 0 0 0 0 1\n1.5 0 zero 0 0 0 0 1\n");
  folder.write("kitti.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  folder.write("empty.tum", "# nothing\n");
  const auto run = [&](const std::string& estimate) {
    return run_mms(folder.path(), {"eval", "trajectory", "a.tum", estimate});
  };
  expect_error(run("missing.tum"), "missing.tum: ");
  expect_error(run("late.tum"), "0 of 3 estimated poses match");
  expect_error(run("garbled.tum"), "garbled.tum:2: ");
  expect_error(run("kitti.txt"), "kitti.txt: has another format than a.tum");
  expect_error(run("empty.tum"), "empty.tum: ");
}

TEST(EvalDrift, IsDistanceFromFirstPose) {
  const TempFolder folder;
  folder.write("a.tum", "1 1 0 0 0 0 0 1\n2 1.01 0 0 0 0 0 1\n3 1 0.03 0 0 0 0 1\n");
  const auto json = json_of(run_mms(folder.path(), {"eval", "drift", "a.tum", "--json"}));
  EXPECT_EQ(keys_of(json), (Keys{"poses", "atde_m", "mtde_m"}));
  EXPECT_EQ(json["poses"], 3);
  EXPECT_NEAR(json["mtde_m"], 0.03, 1e-9);
  expect_error(run_mms(folder.path(), {"eval", "drift", "missing.tum"}), "missing.tum: ");
}

PointCloudFile points_at(const std::vector<Eigen::Vector3f>& points) {
  PointCloudFile file;
  file.points = points;
  return file;
}

TEST(EvalMap, CountsKeptAndRemovedPoints) {
  const TempFolder folder;
  PointCloudFile truth = points_at({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  truth.labels = {0, 0, 1, 1};
  write_ply(folder.path() / "truth.ply", truth);
  write_ply(folder.path() / "map.ply", points_at({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  const auto json =
      json_of(run_mms(folder.path(), {"eval", "map", "truth.ply", "map.ply", "--json"}));
  EXPECT_EQ(keys_of(json), (Keys{"sa_pct", "da_pct", "aa_pct", "ha_pct"}));
  EXPECT_NEAR(json["sa_pct"], 100.0, 1e-9);
  EXPECT_NEAR(json["da_pct"], 50.0, 1e-9);
}

TEST(EvalMap, ErrorsAreOneLine) {
  const TempFolder folder;
  write_ply(folder.path() / "map.ply", points_at({{0, 0, 0}}));
  folder.write("bad.ply", "no ply at all\n");
  expect_error(run_mms(folder.path(), {"eval", "map", "map.ply", "map.ply"}),
               "map.ply: has no property 'label'");
  expect_error(run_mms(folder.path(), {"eval", "map", "bad.ply", "map.ply"}), "bad.ply");
  expect_error(run_mms(folder.path(), {"eval", "map", "none.ply", "map.ply"}), "none.ply: ");
}

TEST(EvalGhostPoints, IsSmallForOwnMap) {
  const TempFolder folder;
  const std::string still = "sim:corridor?trajectory=still&crossing=1&width=320&frames=12";
  expect_success(run_mms(folder.path(), {"run", still, "--segmenter", "masks", "-o", "out"}));
  const auto json = json_of(
      run_mms(folder.path(), {"eval", "ghost-points", still, "out/static_map.ply", "--json"}));
  EXPECT_EQ(keys_of(json), (Keys{"points", "seen", "ghost_points", "ghost_pct"}));
  EXPECT_GT(json["seen"], 4000);
  EXPECT_LT(json["ghost_pct"], 1.0);
}

TEST(EvalGhostPoints, ErrorsAreOneLine) {
  const TempFolder folder;
  write_hall(folder.path() / "hall", 1);
  write_ply(folder.path() / "map.ply", points_at({{0, 0, 0}}));
  expect_error(run_mms(folder.path(), {"eval", "ghost-points", "hall", "map.ply"}),
               "hall: has no depth images");
  expect_error(run_mms(folder.path(), {"eval", "ghost-points", "nowhere", "map.ply"}), "nowhere: ");
}

/// One person and one vehicle in two images; the first image is for training.
CocoDataset two_images() {
  const Rle mask{4, 3, {3, 6, 3}};
  CocoDataset truth;
  truth.images = {{1, "a.png", 4, 3, "train"}, {2, "b.png", 4, 3, "holdout"}};
  truth.categories = {{1, "person"}, {2, "agv"}};
  truth.annotations = {coco_annotation(1, 1, 1, mask), coco_annotation(2, 2, 2, mask)};
  return truth;
}

/// A folder with the ground truth and results that contain only the person.
class EvalSegmentation : public ::testing::Test {
 protected:
  EvalSegmentation() {
    const CocoDataset truth = two_images();
    write_coco(folder_.path() / "truth.json", truth);
    write_coco_results(folder_.path() / "found.json",
                       {{1, 1, 0.9, truth.annotations[0].segmentation}});
  }

  Outcome run(const std::vector<std::string>& more, const std::string& truth = "truth.json",
              const std::string& found = "found.json") const {
    std::vector<std::string> arguments = {"eval", "segmentation", truth, found};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_mms(folder_.path(), arguments);
  }

  TempFolder folder_;
};

TEST_F(EvalSegmentation, JsonHasDocumentedKeys) {
  const Keys keys = {"AP",  "AP50", "AP75",  "APs", "APm", "APl",
                     "AR1", "AR10", "AR100", "ARs", "ARm", "ARl"};
  const auto json = json_of(run({"--json"}));
  Keys with_classes = keys;
  with_classes.insert("per_class");
  EXPECT_EQ(keys_of(json), with_classes);
  EXPECT_EQ(keys_of(json["per_class"]), (Keys{"agv", "person"}));
  EXPECT_EQ(keys_of(json["per_class"]["agv"]), keys);
  EXPECT_NEAR(json["AP"], 0.5, 1e-9);
  EXPECT_NEAR(json["per_class"]["person"]["AP"], 1.0, 1e-9);
  EXPECT_NEAR(json["per_class"]["agv"]["AP"], 0.0, 1e-9);
  EXPECT_TRUE(json["APl"].is_null());
}

TEST_F(EvalSegmentation, PixelsHaveDocumentedKeys) {
  const auto json = json_of(run({"--json", "--pixels"}))["pixels"];
  EXPECT_EQ(keys_of(json), (Keys{"all", "tall", "medium", "small"}));
  EXPECT_EQ(keys_of(json["all"]), (Keys{"objects", "recall", "precision"}));
  EXPECT_EQ(json["all"]["recall"], 1.0);
  EXPECT_EQ(json["all"]["precision"], 1.0);
  const auto agv = json_of(run({"--json", "--pixels", "--category", "agv"}))["pixels"];
  EXPECT_EQ(agv["all"]["recall"], 0.0);
  EXPECT_TRUE(agv["all"]["precision"].is_null());
  expect_in("pixels of class person under masks of score 0.30 or more", run({"--pixels"}).out);
}

TEST_F(EvalSegmentation, LowestScoreNeedsPixels) {
  expect_usage_error(run({"--min-score", "0.5"}), "--min-score requires --pixels");
}

TEST_F(EvalSegmentation, TableHasLinePerClass) {
  const Outcome outcome = run({});
  expect_success(outcome);
  expect_in("2 images with 2 objects; 1 of 1 results", outcome.out);
  expect_in("\nperson  1.000  1.000  1.000  1.000    n/a", outcome.out);
  expect_in("\nagv     0.000", outcome.out);
  expect_in("\nall     0.500", outcome.out);
}

TEST_F(EvalSegmentation, SelectsClassOrSplit) {
  const auto person = json_of(run({"--json", "--category", "person"}));
  EXPECT_EQ(keys_of(person["per_class"]), (Keys{"person"}));
  EXPECT_NEAR(person["AP"], 1.0, 1e-9);
  const auto holdout = json_of(run({"--json", "--split", "holdout"}));
  EXPECT_NEAR(holdout["AP"], 0.0, 1e-9);
  EXPECT_TRUE(holdout["per_class"]["person"]["AP"].is_null());
}

TEST_F(EvalSegmentation, WrongNamesAreOneLineErrors) {
  expect_error(run({"--category", "cat"}),
               "truth.json: has no class 'cat' (its classes: agv, person)");
  expect_error(run({"--split", "test"}),
               "truth.json: has no images in the split 'test' (its splits: holdout, train)");
}

TEST_F(EvalSegmentation, DamagedFilesAreOneLineErrors) {
  folder_.write("cut.json", R"([{"image_id": 1)");
  folder_.write("empty.json", "");
  folder_.write("number.json", "[3]");
  folder_.write("stranger.json", R"([{"image_id": 9, "category_id": 1, "score": 0.5,)"
                                 R"("segmentation": {"size": [3, 4], "counts": [12]}}])");
  folder_.write("turned.json", R"([{"image_id": 1, "category_id": 1, "score": 0.5,)"
                               R"("segmentation": {"size": [4, 3], "counts": [12]}}])");
  const auto expect_error_of = [&](const std::string& found, const std::string& part) {
    expect_error(run({}, "truth.json", found), part);
  };
  expect_error_of("missing.json", "missing.json: ");
  expect_error_of("cut.json", "cut.json: is not JSON: parse error");
  expect_error_of("empty.json", "empty.json: is not JSON: parse error");
  expect_error_of("number.json", "number.json: [0]: is a number, expected an object");
  expect_error_of("truth.json", "truth.json: is not a list of results");
  expect_error_of("stranger.json", "stranger.json: [0].image_id: is 9, no such image");
  expect_error_of("turned.json",
                  "turned.json: [0].segmentation: has 3 x 4 px, its image 1 has 4 x 3 px");
  expect_error(run({}, "cut.json"), "cut.json: is not JSON: parse error");
  expect_error(run({}, "found.json"), "found.json: is a list, as of results");
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

TEST(EvalGold, Kitti00Drift) {
  const fs::path shared = fs::path(MMS_SOURCE_DIR) / "../shared/data/trajectories";
  if (!fs::exists(shared)) GTEST_SKIP() << "no shared data in ../shared/data";
  const TempFolder folder;
  const auto json =
      json_of(run_mms(folder.path(), {"eval", "trajectory", shared / "KITTI_00_gt.txt",
                                      shared / "KITTI_00_ORB.txt", "--json"}));
  // Published for stereo ORB-SLAM2: 0.70 % and 0.25 degrees per 100 m.
  EXPECT_NEAR(json["kitti_trans_pct"], 0.699728664, 1e-6);
  // The arc cosine of the devkit has fewer digits at small angles.
  EXPECT_NEAR(json["kitti_rot_deg_per_100m"], 0.253330235, 2e-5);
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

TEST(EvalGold, CocoMasks) {
  const fs::path shared = fs::path(MMS_SOURCE_DIR) / "../shared/data/coco_eval";
  if (!fs::exists(shared)) GTEST_SKIP() << "no shared data in ../shared/data";
  const TempFolder folder;
  const auto json = json_of(
      run_mms(folder.path(), {"eval", "segmentation", shared / "instances_val2014_100.json",
                              shared / "instances_val2014_fakesegm100_results.json", "--json"}));
  const std::map<std::string, double> gold = {
      {"AP", 0.3195452758576433},  {"AP50", 0.5622883972521636},  {"AP75", 0.29892653412086784},
      {"APs", 0.3873740315997838}, {"APm", 0.31018272403369485},  {"APl", 0.3269339071005138},
      {"AR1", 0.2682297225711534}, {"AR10", 0.41544868114906375}, {"AR100", 0.4168394992198818},
      {"ARs", 0.4694498622754236}, {"ARm", 0.37675922666197265},  {"ARl", 0.3814715099715099}};
  for (const auto& [key, value] : gold) EXPECT_NEAR(json[key], value, 1e-9) << key;
  const auto& person = json["per_class"]["person"];
  EXPECT_NEAR(person["AP"], 0.2698816207265341, 1e-9);
  EXPECT_NEAR(person["AP50"], 0.6131378135415071, 1e-9);
  EXPECT_NEAR(person["AP75"], 0.17882861007060288, 1e-9);
}

}  // namespace
}  // namespace mms
