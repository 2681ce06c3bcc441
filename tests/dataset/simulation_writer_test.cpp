#include "mms/dataset/simulated/simulation_writer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/recorder/recorded_frame.hpp"
#include "mms/dataset/recorder/recording_folder.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"
#include "tests/dataset/recording.hpp"
#include "tests/dataset/same_frame.hpp"
#include "tests/dataset/simulated_frames.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

void write_frames(const fs::path& folder, const SensorPreset& sensor, int count,
                  bool overwrite = false) {
  SimulationWriter writer(folder, {}, sensor, overwrite);
  for (int i = 0; i < count; ++i) {
    writer.add(synthetic_frame(i, sensor), synthetic_pose(i, sensor));
  }
  writer.finish();
}

void expect_playback(const fs::path& folder, const SensorPreset& sensor, std::size_t count) {
  const Playback played(open_dataset(folder));
  EXPECT_TRUE(played.warnings.empty()) << played.warnings.front();
  ASSERT_EQ(played.frames.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = static_cast<int>(i);
    expect_same_frame(played.frames[i], as_recorded(synthetic_frame(index, sensor), {}, sensor));
    ASSERT_EQ(played.source->ground_truth().size(), count);
    const StampedPose& pose = played.source->ground_truth()[i];
    EXPECT_EQ(pose.stamp, played.frames[i].stamp);
    EXPECT_NEAR(pose.T_world_sensor.translation().x(), 0.1 * index, 1e-12);
  }
}

TEST(SimulationWriter, DepthCameraRecordingPlaysBack) {
  const TempFolder folder;
  write_frames(folder.path(), small_sensor(), 3);
  expect_playback(folder.path(), small_sensor(), 3);
}

TEST(SimulationWriter, LidarRecordingPlaysBack) {
  const TempFolder folder;
  write_frames(folder.path(), small_sensor(true), 3);
  expect_playback(folder.path(), small_sensor(true), 3);
  EXPECT_FALSE(fs::exists(folder.path() / "map_truth.ply"));
  EXPECT_EQ(read_trajectory_tum(folder.path() / "groundtruth.txt").size(), 3U);
}

TEST(SimulationWriter, WritesInstancesBesideMasks) {
  const TempFolder folder;
  write_frames(folder.path(), small_sensor(), 1);
  EXPECT_EQ(read_mask(folder.path() / "instances/0.000000001.png")(0, 0), 1 + kObjectId);
  EXPECT_EQ(read_mask(folder.path() / "masks/0.000000001.png")(0, 0), 1);
}

TEST(SimulationWriter, WritesGroundTruthOfObjects) {
  const TempFolder folder;
  write_frames(folder.path(), small_sensor(), 2);
  const auto json = nlohmann::json::parse(read_file(folder.path() / "objects_truth.json"));
  ASSERT_EQ(json["frames"].size(), 2U);
  EXPECT_EQ(json["frames"][1]["stamp"], "0.100000001");
  const auto& person = json["frames"][1]["objects"][0];
  EXPECT_EQ(person["id"], kObjectId);
  EXPECT_EQ(person["label"], 1 + kObjectId);
  EXPECT_EQ(person["class"], "person");
  EXPECT_EQ(person["size"], nlohmann::json({0.5, 0.6, 1.8}));
  EXPECT_EQ(person["quaternion"], nlohmann::json({0.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(person["velocity"], nlohmann::json({1.0, 0.0, 0.0}));
  EXPECT_EQ(person["amodal_box"], nlohmann::json({-4.0, 0.0, 20.0, 24.0}));
  EXPECT_EQ(person["moving"], true);
  EXPECT_TRUE(json["frames"][0]["objects"][1]["visible_box"].is_null());
  EXPECT_EQ(json["frames"][0]["objects"][1]["kind"], "forklift");
}

TEST(SimulationWriter, AnnotationsNameImages) {
  const TempFolder folder;
  write_frames(folder.path(), small_sensor(), 2);
  const CocoDataset dataset = read_coco(folder.path() / "instances.json");
  ASSERT_EQ(dataset.images.size(), 2U);
  EXPECT_EQ(dataset.annotations.size(), 2U);
  for (const CocoImage& image : dataset.images) {
    EXPECT_EQ(read_color(folder.path() / image.file_name).width(), image.width);
  }
}

TEST(SimulationWriter, GroundTruthMapComesWithLastFrame) {
  const TempFolder folder;
  write_frames(folder.path(), small_sensor(), 2);
  const auto source = open_dataset(folder.path());
  source->next();
  EXPECT_FALSE(source->map_truth());
  source->next();
  const auto map = source->map_truth();
  ASSERT_TRUE(map);
  EXPECT_EQ(map->labels, read_ply(folder.path() / "map_truth.ply").labels);
  EXPECT_EQ(map->labels.back(), 1 + kObjectId);
  const auto skipping = open_dataset(folder.path());
  skipping->skip(1);
  skipping->next();
  EXPECT_FALSE(skipping->map_truth());
  EXPECT_TRUE(any_has(source->describe(), "map truth: map_truth.ply"));
}

TEST(SimulationWriter, RejectsGroundTruthMapWithoutLabels) {
  const TempFolder folder;
  write_frames(folder.path(), small_sensor(), 1);
  PointCloudFile map;
  map.points = {{1.0F, 2.0F, 3.0F}};
  write_ply(folder.path() / "map_truth.ply", map);
  const auto source = open_dataset(folder.path());
  source->next();
  expect_in("map_truth.ply: has no property 'label'",
            message_of<DataError>([&] { source->map_truth(); }));
}

TEST(SimulationWriter, ReplacesEarlierSimulation) {
  const TempFolder folder;
  write_frames(folder.path(), small_sensor(), 3);
  folder.write("notes.txt", "mine");
  expect_in("has an earlier simulation (replace it with --overwrite",
            message_of<FileError>([&] { write_frames(folder.path(), small_sensor(true), 2); }));
  expect_playback(folder.path(), small_sensor(), 3);
  write_frames(folder.path(), small_sensor(true), 2, true);
  EXPECT_FALSE(fs::exists(folder.path() / "rgb"));
  EXPECT_EQ(read_file(folder.path() / "notes.txt"), "mine");
  expect_playback(folder.path(), small_sensor(true), 2);
}

TEST(SimulationWriter, KeepsOtherFolders) {
  const TempFolder folder;
  folder.write("holiday.jpg", "x");
  expect_in("is not empty (it has holiday.jpg) and not an earlier simulation (choose a new folder",
            message_of<FileError>([&] { write_frames(folder.path(), small_sensor(), 1); }));
  folder.write("mine/scene.yaml", "seed: 3\n");  // a file of the user does not mark a recording
  expect_in("it has scene.yaml", message_of<FileError>([&] {
              write_frames(folder.path() / "mine", small_sensor(), 1);
            }));
  expect_in("cannot create the folder", message_of<FileError>([&] {
              write_frames(folder.path() / "holiday.jpg", small_sensor(), 1);
            }));
}

TEST(SimulationWriter, SceneConfigRoundTrips) {
  const TempFolder folder;
  SceneConfig config;
  config.seed = 77;
  config.mask_errors.enabled = true;
  prepare_recording_folder(folder.path() / "new", config, false);
  SceneConfig read;
  load_config(folder.path() / "new/scene.yaml", read);
  EXPECT_EQ(read.seed, 77);
  EXPECT_TRUE(read.mask_errors.enabled);
}

TEST(SimulationWriter, RejectsRecordingWithoutFrames) {
  const TempFolder folder;
  expect_in("the recording has no frames",
            message_of<DataError>([&] { write_frames(folder.path(), small_sensor(), 0); }));
}

}  // namespace
}  // namespace mms
