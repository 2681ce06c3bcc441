#include "mms/dataset/simulated/scene_source.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/simulated/simulation_writer.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "tests/dataset/recording.hpp"
#include "tests/dataset/same_frame.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

SceneConfig small_scene(const char* sensor) {
  SceneConfig config = scene_config("still_walker");
  config.frames = 2;
  config.width = 96;
  config.mask_errors.enabled = true;
  const auto names = sensor_names();
  config.sensor = static_cast<int>(std::find(names.begin(), names.end(), sensor) - names.begin());
  return config;
}

class SceneSourceOf : public ::testing::TestWithParam<const char*> {};

TEST_P(SceneSourceOf, EqualsItsRecording) {
  const TempFolder folder;
  const SceneConfig config = small_scene(GetParam());
  SimulatedScene scene(config);
  const auto recording = folder.path() / "recording";
  const WrittenRecording written = write_simulation(scene, recording, {.static_spacing = 0.3});
  EXPECT_EQ(written.frames, 2);
  const Playback direct(play_scene(config, true));
  const Playback recorded(open_dataset(recording));
  ASSERT_EQ(direct.frames.size(), 2U);
  ASSERT_EQ(recorded.frames.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) expect_same_frame(direct.frames[i], recorded.frames[i]);
  const auto map = direct.source->map_truth();
  const auto recorded_map = recorded.source->map_truth();
  ASSERT_EQ(map.has_value(), recorded_map.has_value());
  if (map) {
    EXPECT_TRUE(map->points == recorded_map->points);
    EXPECT_EQ(map->labels, recorded_map->labels);
    EXPECT_EQ(map->points.size(), written.map_points);
  }
  EXPECT_GT(read_ply(recording / "static_truth.ply").normals.size(), 100U);
  const Trajectory dense = read_trajectory_tum(recording / "groundtruth_dense.txt");
  EXPECT_GT(dense.size(), 10U);
  EXPECT_EQ(dense.back().stamp, recorded.frames[1].stamp);
}

INSTANTIATE_TEST_SUITE_P(Sensors, SceneSourceOf, ::testing::Values("d435", "lidar16"));

TEST(SceneSource, OpensByAddress) {
  const Playback played(
      open_dataset("sim:crowd?frames=1&width=64&sensor=kinect&seed=3&mask_errors.enabled=true"));
  ASSERT_EQ(played.frames.size(), 1U);
  EXPECT_EQ(played.frames[0].color.width(), 64);
  const auto facts = played.source->describe();
  EXPECT_TRUE(any_has(facts, "simulated scene crowd, seed 3"));
  EXPECT_TRUE(any_has(facts, "kinect"));
  EXPECT_TRUE(any_has(facts, "masks: with errors"));
}

TEST(SceneSource, HasNoMasksWhenDisabled) {
  const auto source =
      open_dataset("sim:crowd?frames=1&width=64", {.masks = {}, .load_masks = false});
  EXPECT_FALSE(source->has_masks());
  EXPECT_TRUE(source->next()->mask.empty());
}

TEST(SceneSource, KeepsGroundTruthMapOnlyWhenEnabled) {
  const auto map_after_a_frame = [](const SourceOptions& options) {
    const auto source = open_dataset("sim:crowd?frames=1&width=64", options);
    source->next();
    return source->map_truth();
  };
  EXPECT_TRUE(map_after_a_frame({}));
  EXPECT_FALSE(map_after_a_frame({.masks = {}, .load_masks = true, .map_truth = false}));
}

TEST(SceneSource, RecordingStopsOnRequest) {
  const TempFolder folder;
  SimulatedScene scene(small_scene("d435"));
  WriteOptions options;
  options.static_spacing = 0.3;
  options.progress = [](int, int) { return false; };
  EXPECT_EQ(write_simulation(scene, folder.path(), options).frames, 1);
  EXPECT_EQ(open_dataset(folder.path())->size(), 1U);
}

TEST(SceneSource, ErrorsExplainInvalidAddress) {
  const auto error = [](const char* address) {
    return message_of<DataError>([&] { open_dataset(address); });
  };
  expect_in("did you mean 'sim:crowd'?", error("sim:crwd"));
  expect_in("sensor cannot be 'd345' (did you mean 'd435'?)", error("sim:crowd?sensor=d345"));
  expect_in("did you mean 'mask_errors.enabled'?", error("sim:crowd?mask_errors.enabld=true"));
}

}  // namespace
}  // namespace mms
