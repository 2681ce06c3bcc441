#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <sstream>
#include <thread>

#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/json_schema.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using Keys = std::set<std::string>;

constexpr int kFrames = 6;

/// A run that is interrupted after `change` was called, which is when its output folder is in use.
Outcome run_interrupted_after(const TempFolder& folder, const std::function<void()>& change) {
  RunningMms run(folder.path(), {"run", "sim:still_walker", "--segmenter", "none", "-o", "out"});
  for (int i = 0; i < 3000 && !fs::exists(folder.path() / "out/journal.bin"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  change();
  std::this_thread::sleep_for(std::chrono::seconds(2));  // a few frames
  run.send(SIGINT);
  return run.wait();
}

int count_lines(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

/// Runs `mms run` on the folder's recording into out/, with more arguments. By default, the masks
/// are those of the recording.
Outcome run_recording(const TempFolder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"run", "data", "-o", "out", "--overwrite"};
  if (std::find(more.begin(), more.end(), "--segmenter") == more.end()) {
    arguments.insert(arguments.end(), {"--segmenter", segmenter_of(folder.path() / "data")});
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_mms(folder.path(), arguments);
}

void expect_time_statistics(const nlohmann::json& times) {
  EXPECT_EQ(keys_of(times), (Keys{"mean", "p50", "p99"}));
  EXPECT_LE(times["p50"], times["p99"]);
}

TEST(Run, WarnsOfGroundTruthOfAnotherSensor) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(30));
  const fs::path file = folder.path() / "data/groundtruth.txt";
  Trajectory truth = read_trajectory_tum(file);
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()));
  for (StampedPose& pose : truth) {
    pose.T_world_sensor = pose.T_world_sensor * Transform<Sensor, Sensor>(turn);
  }
  const std::string text = "the ground truth moves along other axes than the sensor";
  const Outcome exact = run_recording(folder);
  expect_success(exact);
  EXPECT_EQ(exact.err.find(text), std::string::npos) << exact.err;
  write_trajectory_tum(file, truth);
  const Outcome outcome = run_recording(folder);
  expect_success(outcome);
  expect_in(text, outcome.err);
}

TEST(Run, WritesDocumentedFiles) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  const Outcome outcome = run_recording(folder);
  expect_success(outcome);
  const fs::path out = folder.path() / "out";
  const Trajectory poses = read_trajectory_tum(out / "trajectory.tum");
  ASSERT_EQ(poses.size(), std::size_t{kFrames});
  EXPECT_EQ(poses[0].stamp.to_string(), "100.000000000");
  EXPECT_EQ(read_trajectory_kitti(out / "trajectory_kitti.txt").size(), poses.size());
  EXPECT_GE(read_trajectory_tum(out / "keyframes.tum").size(), 1U);
  const PointCloudFile map = read_ply(out / "static_map.ply");
  EXPECT_GT(map.points.size(), 5000U);
  EXPECT_EQ(map.colors.size(), map.points.size());
  EXPECT_EQ(map.normals.size(), map.points.size());
  EXPECT_FALSE(read_color(out / "pictures/map.png").empty());
  EXPECT_FALSE(read_color(out / "pictures/frame_01.png").empty());
  expect_success(run_mms(folder.path(), {"config", "check", "out/config.yaml"}));
  expect_in("report: out/report.html", outcome.out);
  expect_in("map:    out/static_map.ply", outcome.out);
}

TEST(Run, MetricsHaveDocumentedKeys) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  expect_success(run_recording(folder));
  const auto metrics = json_file(folder.path() / "out/metrics.json");
  EXPECT_EQ(keys_of(metrics),
            (Keys{"version", "frames", "frames_skipped", "rate_hz", "time_per_frame_s", "stages_s",
                  "peak_memory_mb", "status", "dynamic_pct", "implausible_masks",
                  "overruled_frames", "overruled_pct", "tracks", "trajectory", "drift", "loops"}));
  EXPECT_EQ(metrics["frames"], kFrames);
  EXPECT_EQ(metrics["frames_skipped"], 0);
  expect_time_statistics(metrics["time_per_frame_s"]);
  for (const auto& [name, times] : metrics["stages_s"].items()) expect_time_statistics(times);
  int frames = 0;
  for (const auto& [name, count] : metrics["status"].items()) frames += count.get<int>();
  EXPECT_EQ(frames, kFrames);
  EXPECT_GT(metrics["dynamic_pct"], 0.0);
  EXPECT_EQ(keys_of(metrics["trajectory"]),
            (Keys{"matched", "poses", "path_m", "ate_rmse_m", "ate_mean_m", "ate_median_m",
                  "ate_max_m", "rpe_trans_rmse_m", "rpe_rot_rmse_deg"}));
  EXPECT_EQ(metrics["status"]["tracking"], kFrames - 1);
  EXPECT_LT(metrics["trajectory"]["ate_rmse_m"], 0.005);
  EXPECT_EQ(keys_of(metrics["drift"]), (Keys{"poses", "atde_m", "mtde_m"}));
}

TEST(Run, ResultsFollowTheirSchemas) {
  const TempFolder folder;
  const auto schema = [](const std::string& name) {
    return json_file(fs::path(MMS_SOURCE_DIR) / "docs/schema" / (name + ".schema.json"));
  };
  expect_success(run_mms(folder.path(), {"run", "sim:crowd?frames=6", "--segmenter", "masks", "-o",
                                         "out", "--realtime"}));
  auto metrics = json_file(folder.path() / "out/metrics.json");
  EXPECT_EQ(schema_fault(metrics, schema("metrics")), "");
  EXPECT_EQ(schema_fault(json_file(folder.path() / "out/objects.json"), schema("objects")), "");
  metrics["ate_cm"] = 1.0;
  EXPECT_EQ(schema_fault(metrics, schema("metrics")), "$.ate_cm: not in the schema");
}

TEST(Run, RefusesFolderWithOtherFilesOrResults) {
  const TempFolder folder;
  const std::vector<std::string> run = {
      "run", "sim:still_walker?frames=2", "--segmenter", "none", "-o", "out"};
  expect_success(run_mms(folder.path(), run));
  expect_error(run_mms(folder.path(), run),
               "out: has earlier results, as config.yaml (replace them with --overwrite");
  std::vector<std::string> overwrite = run;
  overwrite.push_back("--overwrite");
  expect_success(run_mms(folder.path(), overwrite));
  folder.write("out/notes.txt", "mine");
  expect_error(run_mms(folder.path(), overwrite),
               "out: has a file that this command did not write, as notes.txt");
  EXPECT_EQ(read_file(folder.path() / "out/notes.txt"), "mine");
  EXPECT_TRUE(fs::exists(folder.path() / "out/trajectory.tum"));
}

TEST(Run, NeverWritesIntoRecording) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(2));
  expect_error(
      run_mms(folder.path(), {"run", "data", "--segmenter", "none", "-o", "data", "--overwrite"}),
      "files that this command did not write");
  EXPECT_TRUE(fs::exists(folder.path() / "data/rgb.txt"));
}

TEST(Run, PrintsHeadingAndSections) {
  const TempFolder folder;
  const Outcome outcome = run_mms(
      folder.path(), {"run", "sim:still_walker?frames=3", "--segmenter", "none", "-o", "out"});
  expect_success(outcome);
  expect_in("recording  sim:still_walker?frames=3, 3 frames (simulated scene still_walker)\n",
            outcome.err);
  expect_in("depth camera, 640x480 pixels; masks: none\n", outcome.err);
  expect_in("results    out\n", outcome.err);
  for (const char* title : {"Trajectory: ", "\nMap: ", "\nObjects", "\nSpeed\n"}) {
    expect_in(title, outcome.out);
  }
  std::istringstream lines(outcome.out + outcome.err);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 79U) << line;
}

TEST(Run, PrintsNothingOrJsonOnDemand) {
  const TempFolder folder;
  const std::vector<std::string> run = {
      "run",    "sim:still_walker?frames=2", "-o", "out", "--overwrite", "--segmenter", "none",
      "--quiet"};
  const Outcome quiet = run_mms(folder.path(), run);
  expect_success(quiet);
  EXPECT_EQ(quiet.out + quiet.err, "");
  std::vector<std::string> with_json = run;
  with_json.push_back("--json");
  const Outcome json = run_mms(folder.path(), with_json);
  EXPECT_EQ(nlohmann::json::parse(json.out), json_file(folder.path() / "out/metrics.json"));
}

TEST(Run, TakesSettingsFromCommandLine) {
  const TempFolder folder;
  const auto run = [&](const std::string& setting) {
    return run_mms(folder.path(), {"run", "sim:still_walker?frames=2", "-o", "out", "--overwrite",
                                   "--segmenter", "none", "--set", setting});
  };
  expect_success(run("static_map.voxel_size=0.07"));
  expect_in("voxel_size: 0.07", read_file(folder.path() / "out/config.yaml"));
  expect_error(run("static_map.voxel_sise=0.07"), "did you mean 'static_map.voxel_size'?");
}

TEST(Run, OmitsTrajectoryErrorsWithoutGroundTruth) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(2));
  fs::remove(folder.path() / "data/groundtruth.txt");
  expect_success(run_recording(folder));
  const Keys keys = keys_of(json_file(folder.path() / "out/metrics.json"));
  EXPECT_FALSE(keys.contains("trajectory"));
  EXPECT_FALSE(keys.contains("drift"));
}

TEST(Run, SkipsGroundTruthOfMapOnDemand) {
  const TempFolder folder;
  std::vector<std::string> run = {
      "run", "sim:still_walker?frames=4&width=320", "--segmenter", "masks", "-o", "with"};
  expect_success(run_mms(folder.path(), run));
  run.back() = "without";
  run.emplace_back("--no-map-truth");
  expect_success(run_mms(folder.path(), run));
  const Keys with = keys_of(json_file(folder.path() / "with/metrics.json"));
  const Keys without = keys_of(json_file(folder.path() / "without/metrics.json"));
  for (const char* key : {"map", "objects"}) {
    EXPECT_EQ(with.count(key), 1U);
    EXPECT_EQ(without.count(key), 0U);
  }
  EXPECT_EQ(without.count("trajectory"), 1U);
}

TEST(Run, HoldsPoseOfStillCamera) {
  const TempFolder folder;
  const auto keeps_pose = [&](const std::string& hold) {
    expect_success(run_mms(folder.path(),
                           {"run", "sim:still_walker?frames=12", "--segmenter", "none", "-o", hold,
                            "--set", "odometry.registration.photometric.hold_still=" + hold}));
    const Trajectory trajectory = read_trajectory_tum(folder.path() / hold / "trajectory.tum");
    return trajectory.back().T_world_sensor.isometry().isApprox(
        trajectory[trajectory.size() - 2].T_world_sensor.isometry(), 1e-12);
  };
  EXPECT_TRUE(keeps_pose("true"));
  EXPECT_FALSE(keeps_pose("false"));
}

TEST(Run, ObjectsHaveIdClassBoxAndVelocity) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  expect_success(run_recording(folder));
  const auto objects = json_file(folder.path() / "out/objects.json");
  ASSERT_FALSE(objects["tracks"].empty());
  std::set<int> ids;
  for (const auto& track : objects["tracks"]) {
    EXPECT_EQ(keys_of(track), (Keys{"id", "class", "history"}));
    EXPECT_TRUE(ids.insert(track["id"].get<int>()).second);
    EXPECT_TRUE(track["class"] == "person" || track["class"] == "agv") << track["class"];
    for (const auto& seen : track["history"]) {
      EXPECT_EQ(keys_of(seen),
                (Keys{"stamp", "position", "quaternion", "size", "velocity", "moving", "score"}));
      EXPECT_GT(seen["size"][2], 0.0);
    }
  }
}

TEST(Run, TimingHasRowPerFrameAndColumnPerStage) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  expect_success(run_recording(folder));
  const std::string timing = read_file(folder.path() / "out/timing.csv");
  EXPECT_EQ(count_lines(timing), kFrames + 1);
  expect_in(
      "stamp,read,segmentation,fusion,features,odometry,mapping,stages,interval\n100.000000000,",
      timing);
}

TEST(Run, ReportHasNoExternalReferences) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  expect_success(run_recording(folder));
  const std::string report = read_file(folder.path() / "out/report.html");
  for (const char* part : {"<!DOCTYPE html>", "<svg", "data:image/", "</html>"}) {
    expect_in(part, report);
  }
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "<script src"}) {
    EXPECT_EQ(report.find(outside), std::string::npos) << outside;
  }
}

TEST(Run, StartAndFramesSelectRange) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  expect_success(run_recording(folder, {"--start", "2", "--frames", "3"}));
  const Trajectory poses = read_trajectory_tum(folder.path() / "out/trajectory.tum");
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].stamp.to_string(), "100.133333333");
  expect_error(run_recording(folder, {"--start", "6"}), "--start: is 6, but data has 6 frames");
}

TEST(Run, RunsWarehouseWithoutData) {
  const TempFolder folder;
  const Outcome outcome = run_mms(folder.path(), {"run", "--frames", "5"});
  expect_success(outcome);
  const fs::path latest = folder.path() / "results/latest";
  EXPECT_TRUE(fs::is_symlink(latest));
  EXPECT_TRUE(fs::is_regular_file(latest / "report.html"));
  EXPECT_EQ(json_file(latest / "metrics.json")["frames"], 5);
  expect_in("report: results/", outcome.out);
}

TEST(Run, MeasuresNoiseOfDepthCamera) {
  const TempFolder folder;
  const auto lost = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {
        "run",        "sim:crowd?sensor=d435&frames=8", "--segmenter", "masks", "-o", "out",
        "--overwrite"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    expect_success(run_mms(folder.path(), words));
    return json_file(folder.path() / "out/metrics.json")["status"]["lost"].get<int>();
  };
  EXPECT_EQ(lost({}), 0);
  EXPECT_GT(lost({"--set", "measure_depth_noise=false"}), 0) << "the noise matters here";
}

TEST(Run, LatestLinksToLastRun) {
  const TempFolder folder;
  const std::string small = "sim:corridor?width=320&frames=2";
  expect_success(run_mms(folder.path(), {"run", small, "--segmenter", "masks"}));
  const fs::path first = fs::canonical(folder.path() / "results/latest");
  expect_success(run_mms(folder.path(), {"run", small, "--segmenter", "masks"}));
  const fs::path second = fs::canonical(folder.path() / "results/latest");
  EXPECT_NE(first, second);
  EXPECT_TRUE(fs::exists(first / "metrics.json"));
}

TEST(Run, NothingIsDynamicWithoutMasks) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(2));
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--segmenter", "none"}, {"--fusion", "none"}}) {
    expect_success(run_recording(folder, more));
    EXPECT_EQ(json_file(folder.path() / "out/metrics.json")["dynamic_pct"], 0.0) << more[0];
  }
}

TEST(Run, FusionOptionOverridesConfig) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(2));
  folder.write("settings.yaml", "fusion:\n  mode: none\nstatic_map:\n  voxel_size: 0.05\n");
  expect_success(run_recording(folder, {"-c", "settings.yaml", "--fusion", "vision"}));
  const std::string effective = read_file(folder.path() / "out/config.yaml");
  expect_in("mode: vision", effective);
  expect_in("voxel_size: 0.05", effective);
}

TEST(Run, WritesOtherResultsWhenPicturesFail) {
  const TempFolder folder;
  const Outcome outcome =
      run_interrupted_after(folder, [&] { folder.write("out/pictures", "a file"); });
  EXPECT_NE(outcome.exit_code, 0);
  expect_in("out/pictures: cannot create the folder", outcome.err);
  EXPECT_TRUE(fs::is_regular_file(folder.path() / "out/report.html"));
  EXPECT_TRUE(fs::is_regular_file(folder.path() / "out/static_map.ply"));
}

TEST(Run, RestoresRemovedFolder) {
  const TempFolder folder;
  const fs::path out = folder.path() / "out";
  const Outcome outcome = run_interrupted_after(folder, [&] { fs::remove_all(out); });
  expect_success(outcome);
  expect_in("warning: out was removed during the run; the results are written to out", outcome.err);
  EXPECT_TRUE(fs::is_regular_file(out / "trajectory.tum"));
  EXPECT_TRUE(fs::is_regular_file(out / "run.json"));
}

TEST(Run, KeepsFileInPlaceOfRemovedFolder) {
  const TempFolder folder;
  const fs::path out = folder.path() / "out";
  const Outcome outcome = run_interrupted_after(folder, [&] {
    fs::remove_all(out);
    folder.write("out", "mine");
  });
  expect_success(outcome);
  expect_in("the results are written to out_2", outcome.err);
  EXPECT_EQ(read_file(out), "mine");
  EXPECT_TRUE(fs::is_regular_file(folder.path() / "out_2/trajectory.tum"));
}

TEST(Run, KeepsFileInPlaceOfLink) {
  const TempFolder folder;
  folder.write("results/latest", "mine");
  expect_success(
      run_mms(folder.path(), {"run", "sim:still_walker?frames=3", "--segmenter", "none"}));
  EXPECT_EQ(read_file(folder.path() / "results/latest"), "mine");
}

TEST(Run, NamesResultThatCannotBeWritten) {
  const TempFolder folder;
  const Outcome outcome = run_interrupted_after(
      folder, [&] { fs::create_directories(folder.path() / "out/metrics.json/in_the_way"); });
  EXPECT_NE(outcome.exit_code, 0);
  expect_in("out/metrics.json: cannot be written", outcome.err);
}

TEST(Run, ReadsMasksFromOtherFolder) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(2));
  fs::rename(folder.path() / "data/masks", folder.path() / "people");
  expect_error(run_recording(folder, {"--segmenter", "masks"}), "data: has no masks (add label");
  expect_success(run_recording(folder, {"--segmenter", "masks", "--masks", "people"}));
  EXPECT_GT(json_file(folder.path() / "out/metrics.json")["dynamic_pct"], 0.0);
}

TEST(Run, UsesAndRecordsGivenCalibration) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(2));
  expect_success(run_recording(
      folder, {"--segmenter", "none", "--intrinsics", "200,201,80,60", "--depth-scale", "2500"}));
  const auto record = json_file(folder.path() / "out/run.json");
  EXPECT_EQ(record["calibration"]["intrinsics"], (nlohmann::json{200.0, 201.0, 80.0, 60.0}));
  EXPECT_EQ(record["calibration"]["depth_scale"], 2500.0);
  EXPECT_EQ(record["camera"]["fy"], 201.0);
  fs::rename(folder.path() / "data/calibration.yaml", folder.path() / "mine.yaml");
  expect_success(run_recording(folder, {"--segmenter", "none", "--calibration", "mine.yaml"}));
  EXPECT_EQ(json_file(folder.path() / "out/run.json")["calibration"]["file"],
            (fs::canonical(folder.path()) / "mine.yaml").string());
  expect_error(run_recording(folder, {"--calibration", "mine.yaml", "--rate", "10"}),
               "data: has time stamps of its own");
  expect_usage_error(run_recording(folder, {"--rate", "nan"}),
                     "--rate: nan is not a number from 0.2 to 1000");
  expect_usage_error(run_recording(folder, {"--intrinsics", "200,0,80,60"}),
                     "--intrinsics: 200,0,80,60 is not fx,fy,cx,cy in pixels");
  for (const char* scale : {"nan", "0", "-1", "x"}) {
    expect_usage_error(run_recording(folder, {"--depth-scale", scale}),
                       std::string("--depth-scale: ") + scale + " is not a number from 0.001");
  }
}

TEST(Run, AcceptsOtherNetwork) {
  const TempFolder folder;
  const auto with = [&](const std::vector<std::string>& words) {
    std::vector<std::string> arguments = {"run", "sim:corridor?width=320&frames=2", "-o", "out",
                                          "--overwrite"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    return run_mms(folder.path(), arguments);
  };
  expect_success(with({"--weights", MMS_SOURCE_DIR "/weights/nano.safetensors"}));
  expect_success(with({"--weights", "nano"}));
  expect_in("weights: " MMS_SOURCE_DIR "/weights/nano.safetensors",
            read_file(folder.path() / "out/config.yaml"));
  expect_error(with({"--weights", "no.safetensors"}), "no.safetensors: ");
  expect_error(with({"--weights", "small"}), "weights/small.safetensors: is neither in");
  expect_usage_error(with({"--weights", "no.safetensors", "--segmenter", "none"}),
                     "--weights: is for masks of the network, but they come from none");
}

/// The settings of the results are used in other working folders, as by mms view.
TEST(Run, KeepsAbsolutePathOfNetwork) {
  const TempFolder folder;
  fs::copy(MMS_SOURCE_DIR "/weights/nano.safetensors", folder.path() / "own.safetensors");
  const std::string path = (fs::canonical(folder.path()) / "own.safetensors").string();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--weights", "own.safetensors"},
        {"--set", "segmentation.weights=own.safetensors"}}) {
    std::vector<std::string> arguments = {"run", "sim:corridor?width=320&frames=2", "-o", "out",
                                          "--overwrite"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    expect_success(run_mms(folder.path(), arguments));
    expect_in("weights: " + path, read_file(folder.path() / "out/config.yaml"));
  }
}

TEST(Run, RealTimeProcessesOrCountsEveryFrame) {
  const TempFolder folder;
  expect_success(run_mms(folder.path(), {"run", "sim:corridor?width=320&frames=8&hz=40",
                                         "--realtime", "--segmenter", "masks", "-o", "out"}));
  const auto metrics = json_file(folder.path() / "out/metrics.json");
  EXPECT_EQ(metrics["frames"].get<int>() + metrics["frames_skipped"].get<int>(), 8);
}

TEST(Run, PipedProgressHasPlainLines) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(2));
  const Outcome outcome = run_recording(folder);
  EXPECT_EQ(lines_with(outcome, "frame 2/2  "), 1) << outcome.err;
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos);
}

TEST(Run, LocalizesLidar) {
  const TempFolder folder;
  write_hall(folder.path() / "data", 4);
  expect_success(run_recording(folder));
  const Trajectory poses = read_trajectory_tum(folder.path() / "out/trajectory.tum");
  ASSERT_EQ(poses.size(), 4U);
  EXPECT_EQ(poses[3].stamp.to_string(), "0.300000000");
  EXPECT_NEAR(poses[3].T_world_sensor.translation().x(), 0.15, 0.03);
}

}  // namespace
}  // namespace mms
