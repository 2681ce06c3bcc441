#include "mms/dataset/recorder/recording_thread.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mms/core/error.hpp"

namespace mms {
namespace {

/// Fails at a frame.
class FullDisk final : public FrameRecorder {
 public:
  explicit FullDisk(std::vector<std::int64_t>& added) : added_(added) {}
  void add(const Frame& frame) override {
    if (frame.index == 1) throw FileError("x.png", "no space left");
    added_.push_back(frame.index);
  }
  void finish(const Trajectory&) override { added_.push_back(-1); }

 private:
  std::vector<std::int64_t>& added_;
};

TEST(RecordingThread, EndsWithFramesBeforeFault) {
  std::vector<std::int64_t> added;
  std::vector<std::string> warnings;
  RecordingThread thread(std::make_unique<FullDisk>(added),
                         [&](const std::string& message) { warnings.push_back(message); });
  for (const int i : {0, 1}) {
    Frame frame;
    frame.index = i;
    thread.add(frame);
  }
  thread.finish();
  EXPECT_EQ(added, (std::vector<std::int64_t>{0, -1}));
  thread.add(Frame());
  EXPECT_EQ(warnings, std::vector<std::string>{"recording ended: x.png: no space left"});
}

}  // namespace
}  // namespace mms
