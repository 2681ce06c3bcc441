#include "mms/server/scene/viewer_scene.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <thread>
#include <vector>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/server/scenes.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

std::vector<SceneFrame> frames_of(const Scene& scene, std::size_t first, std::size_t last) {
  std::vector<SceneFrame> frames;
  scene.for_each_frame(first, last, [&](const SceneFrame& frame) { frames.push_back(frame); });
  return frames;
}

TEST(Scene, ReturnsFramesViewAndMap) {
  Scene scene(scene_info(true), 1);
  scene.add(frame_at(0), view_of(0), nullptr);
  scene.add(frame_at(1), view_of(1), floor_map(4));
  EXPECT_EQ(scene.size(), 2U);
  EXPECT_EQ(frames_of(scene, 1, 99).size(), 1U);
  EXPECT_TRUE(frames_of(scene, 2, 1).empty());
  EXPECT_EQ(scene.stamps(), (std::vector{frame_at(0).stamp, frame_at(1).stamp}));
  EXPECT_THROW(scene.frame(2), DataError);
  EXPECT_EQ(scene.view(std::nullopt)->frame, 1U);
  EXPECT_EQ(scene.view(0), nullptr) << "the newest only";
  EXPECT_EQ(scene.read_map([](const MapChunks& map) { return map.size(); }), 16U);
}

TEST(Scene, AddDoesNotWaitForReaders) {
  Scene scene(scene_info(true), 1);
  scene.add(frame_at(0), view_of(0), nullptr);
  std::promise<void> reading;
  std::promise<void> resume;
  std::thread reader([&] {
    scene.read_map([&](const MapChunks&) {
      reading.set_value();
      resume.get_future().wait();
      return 0;
    });
  });
  reading.get_future().wait();
  for (std::size_t i = 1; i < 50; ++i) scene.add(frame_at(i), view_of(i), floor_map(4));
  EXPECT_EQ(scene.size(), 50U);
  resume.set_value();
  reader.join();
  EXPECT_EQ(scene.read_map([](const MapChunks& map) { return map.version(); }), 49U);
}

TEST(Scene, LosesNothingWithConcurrentReaders) {
  Scene scene(scene_info(true), 1);
  std::atomic<bool> done = false;
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back([&] {
      while (!done) {
        const std::size_t size = scene.size();
        EXPECT_EQ(frames_of(scene, 0, size).size(), size);
      }
    });
  }
  constexpr std::size_t kFrames = 3000;
  for (std::size_t i = 0; i < kFrames; ++i) scene.add(frame_at(i), view_of(i), nullptr);
  scene.end("/nowhere");
  done = true;
  for (std::thread& reader : readers) reader.join();
  const std::vector<SceneFrame> frames = frames_of(scene, 0, kFrames + 1);
  ASSERT_EQ(frames.size(), kFrames);
  for (std::size_t i = 0; i < kFrames; ++i) EXPECT_EQ(frames[i].stamp, frame_at(i).stamp);
  EXPECT_EQ(scene.view(std::nullopt)->frame, kFrames - 1);
}

TEST(Scene, ChangesFramesInMemoryAndOnDisk) {
  const TempFolder folder;
  for (const std::filesystem::path& place : {folder.path(), std::filesystem::path()}) {
    Scene scene(scene_info(true), 1);
    scene.keep_on_disk(place);
    constexpr std::size_t kFrames = 2000;  // several batches
    for (std::size_t i = 0; i < kFrames; ++i) scene.add(frame_at(i), nullptr, nullptr);
    scene.change([](std::size_t index, SceneFrame& frame) {
      if (index % 2 == 0) frame.truth.reset();
      frame.series = {static_cast<float>(2 * index)};
      if (index == 5) frame.objects.clear();
    });
    EXPECT_EQ(scene.edition(), 1U);
    const std::vector<SceneFrame> frames = frames_of(scene, 0, kFrames);
    ASSERT_EQ(frames.size(), kFrames);
    for (std::size_t i = 0; i < kFrames; ++i) {
      EXPECT_EQ(frames[i].stamp, frame_at(i).stamp);
      EXPECT_EQ(frames[i].truth.has_value(), i % 2 == 1);
      EXPECT_EQ(frames[i].series, std::vector{static_cast<float>(2 * i)});
      EXPECT_EQ(frames[i].objects.size(), i == 5 ? 0U : 1U);
      EXPECT_EQ(frames[i].T_world_sensor.isometry().matrix(),
                frame_at(i).T_world_sensor.isometry().matrix());
    }
    scene.add(frame_at(kFrames), nullptr, floor_map(4));
    EXPECT_EQ(scene.frame(kFrames).truth->x(), static_cast<double>(kFrames));
  }
}

}  // namespace
}  // namespace mms
