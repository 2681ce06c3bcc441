#include "mms/server/scene/viewer_scene.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <thread>
#include <vector>

#include "tests/server/scenes.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

TEST(Scene, ReturnsFramesViewAndMap) {
  Scene scene(scene_info(true), 1);
  scene.add(frame_at(0), view_of(0), nullptr);
  scene.add(frame_at(1), view_of(1), floor_map(4));
  EXPECT_EQ(scene.size(), 2U);
  EXPECT_EQ(scene.frames(1, 99).size(), 1U);
  EXPECT_TRUE(scene.frames(2, 1).empty());
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
        EXPECT_EQ(scene.frames(0, size).size(), size);
      }
    });
  }
  constexpr std::size_t kFrames = 3000;
  for (std::size_t i = 0; i < kFrames; ++i) scene.add(frame_at(i), view_of(i), nullptr);
  scene.end("/nowhere");
  done = true;
  for (std::thread& reader : readers) reader.join();
  const SceneFrames frames = scene.frames(0, kFrames + 1);
  ASSERT_EQ(frames.size(), kFrames);
  for (std::size_t i = 0; i < kFrames; ++i) EXPECT_EQ(frames[i]->stamp, frame_at(i).stamp);
  EXPECT_EQ(scene.view(std::nullopt)->frame, kFrames - 1);
}

TEST(Scene, ReplacesTruthForLaterReaders) {
  Scene scene(scene_info(true), 1);
  scene.add(frame_at(0), nullptr, nullptr);
  scene.add(frame_at(1), nullptr, nullptr);
  const SceneFrames before = scene.frames(0, 2);
  scene.replace_truth({std::nullopt, Eigen::Vector3d(9.0, 0.0, 0.0)});
  EXPECT_EQ(scene.edition(), 1U);
  EXPECT_FALSE(scene.frames(0, 1).front()->truth.has_value());
  EXPECT_EQ(scene.frames(1, 2).front()->truth->x(), 9.0);
  EXPECT_EQ(before[1]->truth->x(), 1.0);
}

}  // namespace
}  // namespace mms
