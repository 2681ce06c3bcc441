#include "mms/pipeline/async_pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/pipeline/played_scene.hpp"

namespace mms {
namespace {

using testing::mask_system;
using testing::message_of;
using testing::scene_frame;

constexpr std::size_t kFrames = 10;

/// Gives the first `count` frames of the scene.
AsyncPipeline::Source first_frames(std::size_t count) {
  return [count, next = std::size_t{0}]() mutable -> std::optional<Frame> {
    if (next >= count) return std::nullopt;
    return scene_frame(next++);
  };
}

/// Throws when it comes to a frame.
class FailingSegmenter : public Segmenter {
 public:
  explicit FailingSegmenter(std::int64_t at) : at_(at) {}
  Segmentation segment(const Frame& frame) override {
    if (frame.index == at_) throw DataError(frame.name, "the segmenter fails");
    return {};
  }

 private:
  std::int64_t at_;
};

class AsyncPipelineThreads : public ::testing::TestWithParam<int> {
 protected:
  AsyncPipeline pipeline_{{.threads = GetParam()}};
};
INSTANTIATE_TEST_SUITE_P(AsyncPipeline, AsyncPipelineThreads, ::testing::Values(1, 2, 4));

TEST_P(AsyncPipelineThreads, GivesSameBitsAsSynchronousSystem) {
  SlamSystem reference = mask_system();
  SlamSystem system = mask_system();
  std::size_t next = 0;
  const auto caller = std::this_thread::get_id();
  pipeline_.run(system, first_frames(kFrames), [&](const Processed& processed) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    ASSERT_LT(next, kFrames);
    EXPECT_EQ(processed.frame.index, scene_frame(next).index);
    EXPECT_EQ(processed.frame.color.pixels(), scene_frame(next).color.pixels());
    EXPECT_TRUE(testing::same_bits(processed.result, reference.process(scene_frame(next))));
    ++next;
  });
  EXPECT_EQ(next, kFrames);
  EXPECT_EQ(pipeline_.dropped(), 0U);
  EXPECT_EQ(pipeline_.without_masks(), 0U);
  const MapCloud map = system.static_map().cloud();
  EXPECT_EQ(map.points, reference.static_map().cloud().points);
  EXPECT_EQ(map.colors, reference.static_map().cloud().colors);
  EXPECT_EQ(system.dynamic_map().confirmed(), reference.dynamic_map().confirmed());
}

TEST_P(AsyncPipelineThreads, AcceptsEmptySource) {
  SlamSystem system = mask_system();
  int calls = 0;
  pipeline_.run(system, first_frames(0), [&](const Processed&) { ++calls; });
  EXPECT_EQ(calls, 0);
}

TEST_P(AsyncPipelineThreads, RethrowsExceptionOfSource) {
  SlamSystem system = mask_system();
  auto frames = first_frames(kFrames);
  int given = 0;
  const auto source = [&]() -> std::optional<Frame> {
    if (given++ == 3) throw FileError("depth.png", "cannot be read");
    return frames();
  };
  const std::string message =
      message_of<FileError>([&] { pipeline_.run(system, source, [](const Processed&) {}); });
  EXPECT_EQ(message, "depth.png: cannot be read");
  EXPECT_EQ(given, 4);
}

TEST_P(AsyncPipelineThreads, RethrowsExceptionOfSegmenter) {
  SlamSystem system(SystemConfig{}, std::make_unique<FailingSegmenter>(2));
  std::size_t delivered = 0;
  const std::string message = message_of<DataError>([&] {
    pipeline_.run(system, first_frames(kFrames), [&](const Processed&) { ++delivered; });
  });
  EXPECT_EQ(message, scene_frame(2).name + ": the segmenter fails");
  EXPECT_LE(delivered, 2U);
}

TEST_P(AsyncPipelineThreads, RethrowsExceptionOfSinkAndEnds) {
  SlamSystem system = mask_system();
  std::size_t delivered = 0;
  // An endless source: the run ends only if the threads are stopped.
  const auto endless = []() -> std::optional<Frame> { return scene_frame(0); };
  const std::string message = message_of<std::runtime_error>([&] {
    pipeline_.run(system, endless, [&](const Processed&) {
      if (++delivered == 2) throw std::runtime_error("the disk is full");
    });
  });
  EXPECT_EQ(message, "the disk is full");
  EXPECT_EQ(delivered, 2U);
  // And it can be used again.
  SlamSystem fresh = mask_system();
  pipeline_.run(fresh, first_frames(2), [&](const Processed&) { ++delivered; });
  EXPECT_EQ(delivered, 4U);
}

TEST_P(AsyncPipelineThreads, MeasuresLatencyOfLiveFrames) {
  const auto arrived = std::chrono::steady_clock::now() - std::chrono::seconds(10);
  AsyncPipeline pipeline({.threads = GetParam(), .arrival = [arrived] { return arrived; }});
  SlamSystem system = mask_system();
  std::size_t processed = 0;
  pipeline.run(system, first_frames(2), [&](const Processed& p) {
    EXPECT_GE(p.latency_ms.value_or(0.0), 10'000.0);
    ++processed;
  });
  EXPECT_EQ(processed, 2U);
}

TEST_P(AsyncPipelineThreads, ProcessesOrDropsEachRealtimeFrame) {
  AsyncPipeline pipeline({.threads = GetParam(), .realtime = true});
  SlamSystem system = mask_system();
  std::size_t next = 0;
  const auto burst = [&]() -> std::optional<Frame> {
    if (next == 30) return std::nullopt;
    Frame frame = scene_frame(next % kFrames);
    frame.index = static_cast<std::int64_t>(next);
    frame.stamp = Timestamp(static_cast<std::int64_t>(next));  // without delay
    ++next;
    return frame;
  };
  std::size_t processed = 0;
  std::int64_t last = -1;
  pipeline.run(system, burst, [&](const Processed& p) {
    EXPECT_GT(p.frame.index, last);
    EXPECT_GE(p.latency_ms.value_or(-1.0), 0.0);
    last = p.frame.index;
    ++processed;
  });
  EXPECT_GT(processed, 0U);
  EXPECT_EQ(processed + pipeline.dropped(), 30U);
}

/// An error ends the run, since the frames of a sensor have no end.
TEST(AsyncPipelineRealtime, RethrowsExceptionsAndEnds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point limit = Clock::now() + std::chrono::seconds(20);
  bool was_stopped = true;
  const auto endless = [&]() -> std::optional<Frame> {
    was_stopped = Clock::now() < limit;
    if (!was_stopped) return std::nullopt;
    return scene_frame(0);
  };
  SlamSystem system(SystemConfig{}, std::make_unique<FailingSegmenter>(0));
  AsyncPipeline pipeline({.threads = 2, .realtime = true});
  const std::string message =
      message_of<DataError>([&] { pipeline.run(system, endless, [](const Processed&) {}); });
  EXPECT_EQ(message, scene_frame(0).name + ": the segmenter fails");
  EXPECT_TRUE(was_stopped);
}

/// Slow, and finds no objects.
class SlowSegmenter : public Segmenter {
 public:
  Segmentation segment(const Frame&) override {
    ++calls;
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    return {};
  }
  static inline std::atomic<int> calls = 0;
};

TEST(AsyncPipelineRealtime, SkipsMasksBeforeDroppingFrames) {
  SlowSegmenter::calls = 0;
  SystemConfig config;
  config.fusion.stride = 4;
  SlamSystem system(config, std::make_unique<SlowSegmenter>());
  AsyncPipeline pipeline({.threads = 2, .realtime = true, .max_mask_age = 1.0});
  std::size_t next = 0;
  const auto source = [&]() -> std::optional<Frame> {
    if (next == 20) return std::nullopt;
    Frame frame = scene_frame(next % kFrames);
    frame.index = static_cast<std::int64_t>(next);
    frame.stamp = Timestamp(static_cast<std::int64_t>(next) * 40'000'000);
    ++next;
    return frame;
  };
  std::size_t processed = 0;
  pipeline.run(system, source, [&](const Processed&) { ++processed; });
  EXPECT_GT(pipeline.without_masks(), 0U);
  EXPECT_EQ(static_cast<std::size_t>(SlowSegmenter::calls) + pipeline.without_masks(), processed);
  EXPECT_EQ(processed + pipeline.dropped(), 20U);
}

TEST(AsyncPipelineRealtime, DroppedFramesHandOnTheirMotion) {
  SystemConfig config;
  config.fusion.stride = 4;
  SlamSystem system(config, std::make_unique<SlowSegmenter>());
  AsyncPipeline pipeline({.threads = 2, .realtime = true, .max_mask_age = 0.0});
  std::size_t next = 0;
  const auto source = [&]() -> std::optional<Frame> {
    if (next == 20) return std::nullopt;
    Frame frame = scene_frame(next % kFrames);
    frame.stamp = Timestamp(static_cast<std::int64_t>(next++) * 20'000'000);
    frame.motion.imu = {{frame.stamp}};
    return frame;
  };
  std::vector<Timestamp> sensed;
  std::vector<Timestamp> expected;
  pipeline.run(system, source, [&](const Processed& p) {
    for (const ImuSample& sample : p.frame.motion.imu) sensed.push_back(sample.stamp);
    while (expected.size() < sensed.size()) {
      expected.emplace_back(static_cast<std::int64_t>(expected.size()) * 20'000'000);
    }
    EXPECT_EQ(sensed.back(), p.frame.stamp);
  });
  EXPECT_GT(pipeline.dropped(), 0U);
  EXPECT_EQ(sensed, expected);
}

/// Frames that wait since the network was loaded are read without the pauses of their stamps.
TEST(AsyncPipelineRealtime, DoesNotHoldBackLiveFrames) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kPeriod = std::chrono::milliseconds(40);
  SlamSystem system = mask_system();
  const auto first = Clock::now() - 50 * kPeriod;
  int next = 0;
  Clock::time_point arrived;
  Clock::time_point begin;
  Clock::time_point end;
  const auto source = [&]() -> std::optional<Frame> {
    (next == 0 ? begin : end) = Clock::now();
    if (next == 50) return std::nullopt;
    arrived = first + next * kPeriod;
    Frame frame = scene_frame(static_cast<std::size_t>(next) % kFrames);
    frame.index = next;
    frame.stamp = Timestamp(next * std::int64_t{40'000'000});
    ++next;
    return frame;
  };
  AsyncPipeline pipeline(
      {.threads = 2, .realtime = true, .live = true, .arrival = [&] { return arrived; }});
  std::size_t processed = 0;
  pipeline.run(system, source, [&](const Processed& p) {
    EXPECT_GE(p.latency_ms.value_or(0.0), 40.0);  // of the last one, which came a period before
    ++processed;
  });
  EXPECT_LT(end - begin, 45 * kPeriod);
  EXPECT_GT(processed, 0U);
  EXPECT_EQ(processed + pipeline.dropped(), 50U);
}

}  // namespace
}  // namespace mms
