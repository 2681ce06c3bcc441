#include "mms/run/slam_run.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/dataset/live/live_source.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/pipeline/played_scene.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

/// A sensor that gave some frames of a scene, and ended.
class EndedSensor final : public LiveSource {
 public:
  explicit EndedSensor(std::size_t frames) : LiveSource(100) {
    for (std::size_t i = 0; i < frames; ++i) push(scene_frame(i));
    end();
    wait({});
  }
  std::vector<std::string> describe() const override { return {}; }
};

/// A sensor with a warning for each frame, and one at its end.
class DamagedSensor final : public LiveSource {
 public:
  explicit DamagedSensor(std::size_t frames) : LiveSource(100) {
    for (std::size_t i = 0; i < frames; ++i) push(scene_frame(i));
    end();
    wait({});
  }
  std::optional<Frame> next() override {
    constexpr int kImages = 25;
    for (int i = 0; i < kImages; ++i) warn("image " + std::to_string(++images_) + " is damaged");
    std::optional<Frame> frame = LiveSource::next();
    if (!frame) warn("the sensor was unplugged");
    return frame;
  }
  std::vector<std::string> describe() const override { return {}; }

 private:
  int images_ = 0;
};

/// Keeps what is said at the start.
struct Announced : RunObserver {
  std::size_t frames = 0;
  std::vector<std::string> heading;

  void on_start(const std::vector<std::string>& lines, std::size_t count) override {
    heading = lines;
    frames = count;
  }
  void on_frame(const RunLog&) override {}
  void on_warning(const std::string&) override {}
  void on_end() override {}
  bool stop_requested() const override { return false; }
};

RunOptions options_of(std::size_t start) {
  RunOptions options;
  options.data = "camera:test";
  options.segmenter = "none";
  options.start = start;
  return options;
}

TEST(SlamRun, LiveSourcesHaveNoEndAfterSkippedFrames) {
  const TempFolder folder;
  SlamRun run(options_of(2), std::make_unique<EndedSensor>(4));
  Announced announced;
  run.play(folder.path(), announced);
  EXPECT_EQ(run.log().size(), 2U);
  EXPECT_EQ(announced.frames, FrameSource::kEndless);
  expect_in("camera:test, until Ctrl-C", announced.heading.front());
}

TEST(SlamRun, FramesOfLiveSourcesAreThoseAfterTheSkippedOnes) {
  const TempFolder folder;
  RunOptions options = options_of(2);
  options.frames = 1;
  SlamRun run(options, std::make_unique<EndedSensor>(4));
  Announced announced;
  run.play(folder.path(), announced);
  EXPECT_EQ(run.log().size(), 1U);
  EXPECT_EQ(announced.frames, 1U);
}

/// Ends the run before its first frame.
struct Interrupting : Announced {
  std::vector<std::string> warnings;

  void on_warning(const std::string& message) override { warnings.push_back(message); }
  bool stop_requested() const override { return true; }
};

TEST(SlamRun, InterruptedBeforeTheFirstFrameIsNoFaultOfTheRecording) {
  const TempFolder folder;
  SlamRun run(options_of(0), std::make_unique<EndedSensor>(2));
  Interrupting observer;
  expect_in("camera:test: was interrupted before its first frame",
            message_of<DataError>([&] { run.play(folder.path(), observer); }));
  EXPECT_TRUE(run.interrupted());
  EXPECT_TRUE(observer.warnings.empty());  // no results are written
}

/// Takes its time before the first frame, as a map that is loaded.
struct SlowStart : Announced {
  void on_start(const std::vector<std::string>&, std::size_t) override {
    std::this_thread::sleep_for(std::chrono::seconds(3));
  }
};

TEST(SlamRun, RateIsThatOfTheFrames) {
  const TempFolder folder;
  SlamRun run(options_of(0), std::make_unique<EndedSensor>(2));
  SlowStart observer;
  run.play(folder.path(), observer);
  ASSERT_EQ(run.log().frames().size(), 2U);
  EXPECT_LT(run.log().frames().front().interval_ms, 3000.0);
  EXPECT_GT(run.log().metrics().rate_hz, 2.0 / 3.0);
}

TEST(SlamRun, ReportHasWarningsOfAllKinds) {
  const TempFolder folder;
  SlamRun run(options_of(0), std::make_unique<DamagedSensor>(4));
  Announced announced;
  run.play(folder.path(), announced);
  run.write(folder.path());
  const std::string report = read_file(folder.path() / "report.html");
  expect_in("image 3 is damaged", report);
  EXPECT_EQ(report.find("image 4 is damaged"), std::string::npos);
  expect_in("more like: image 1 is damaged", report);
  expect_in("the sensor was unplugged", report);
}

TEST(SlamRun, ErrorOfLiveSourcesHasNoCount) {
  const TempFolder folder;
  Announced announced;
  SlamRun run(options_of(2), std::make_unique<EndedSensor>(1));
  expect_in("camera:test: none of its frames after the first 2 could be processed",
            message_of<DataError>([&] { run.play(folder.path(), announced); }));
}

}  // namespace
}  // namespace mms
