#include "mms/dataset/live/live_source.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace mms {
namespace {

Frame numbered_frame(int index) {
  Frame frame;
  frame.index = index;
  frame.calibration = std::make_shared<const Calibration>();
  return frame;
}

/// A sensor whose frames come when the test says so.
class HandSource final : public LiveSource {
 public:
  explicit HandSource(std::size_t capacity) : LiveSource(capacity) {}
  std::vector<std::string> describe() const override { return {}; }
  using LiveSource::end;
  using LiveSource::push;
};

TEST(LiveSource, CountsDroppedFramesAndWarnsOnce) {
  HandSource source(2);
  std::vector<std::string> warnings;
  source.push(numbered_frame(0));
  ASSERT_TRUE(source.wait([&](const std::string& message) { warnings.push_back(message); }));
  EXPECT_TRUE(source.calibration());
  for (const int i : {1, 2, 3, 4}) source.push(numbered_frame(i));
  source.end();
  EXPECT_EQ(source.dropped(), 2U);
  EXPECT_EQ(warnings,
            std::vector<std::string>{
                "frames are dropped: the run is slower than the sensor (--realtime keeps the "
                "latency small)"});
  for (const int i : {0, 3, 4}) EXPECT_EQ(source.next()->index, i);
  EXPECT_FALSE(source.next());
}

TEST(LiveSource, WaitEndsWithoutFrame) {
  HandSource source(2);
  source.end();
  EXPECT_FALSE(source.wait({}));
}

TEST(LiveSource, KeepsWarningsUntilThereIsAHandler) {
  HandSource source(2);
  source.warn("unplugged");
  std::vector<std::string> heard;
  source.on_warning([&](const std::string& message) { heard.push_back(message); });
  source.on_warning({});
  source.warn("dropped");
  source.on_warning([&](const std::string& message) { heard.push_back(message); });
  EXPECT_EQ(heard, (std::vector<std::string>{"unplugged", "dropped"}));
}

}  // namespace
}  // namespace mms
