#include "mms/dataset/plausibility/recording_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "mms/dataset/open_dataset.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using Frames = std::vector<Frame>;
using Change = void (*)(Frame& frame);

/// Frames spread over a recording, or every `step`-th one from its beginning. Simulated ones are 1
/// s apart.
Frames frames_of(const std::string& data, std::size_t step = 0) {
  const auto source = open_dataset(data, {});
  if (step == 0) step = source->size() / RecordingCheck::kFrames;
  Frames frames;
  while (frames.size() < RecordingCheck::kFrames) {
    frames.push_back(source->next().value());
    source->skip(step - 1);
  }
  return frames;
}

/// Frames in sequence from the middle of a recording.
Frames sequence_of(const std::string& data, std::size_t count = RecordingCheck::kSequence) {
  const auto source = open_dataset(data, {});
  source->skip((source->size() - count) / 2);
  Frames frames;
  while (frames.size() < count) frames.push_back(source->next().value());
  return frames;
}

std::string text_of(const RecordingCheck& check) {
  std::string text;
  for (const std::string& fault : check.faults()) text += fault + "\n";
  return text;
}

/// All faults of frames in sequence, in one text.
std::string faults_in_sequence(const Frames& frames) {
  RecordingCheck check;
  for (const Frame& frame : frames) check.add_in_sequence(frame);
  return text_of(check);
}

/// The frames with the depth images and masks of others, so many frames before; fewer frames.
Frames delayed(const Frames& frames, std::ptrdiff_t depth, std::ptrdiff_t mask = 0) {
  const std::ptrdiff_t margin = std::max(std::abs(depth), std::abs(mask));
  Frames result;
  for (auto frame = frames.begin() + margin; frame < frames.end() - margin; ++frame) {
    result.push_back(*frame);
    result.back().depth = (frame - depth)->depth;
    result.back().mask = (frame - mask)->mask;
  }
  return result;
}

/// All faults of the frames, in one text.
std::string faults_of(const Frames& frames, Change change = nullptr) {
  RecordingCheck check;
  for (Frame frame : frames) {
    if (change != nullptr) change(frame);
    check.add(frame);
  }
  return text_of(check);
}

template <int kPermille>
void scale_depth(Frame& frame) {
  for (float& depth : frame.depth.pixels()) depth *= 0.001F * kPermille;
}

/// @param from  pixel of the right depth image that comes to x, y
template <class From>
void rearrange(Image<float>& depth, const From& from) {
  const Image<float> right = depth;
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      const auto [from_x, from_y] = from(x, y);
      depth(x, y) = right(from_x, from_y);
    }
  }
}

void mirror(Frame& frame) {
  rearrange(frame.depth, [&](int x, int y) { return std::pair(frame.depth.width() - 1 - x, y); });
}

void flip(Frame& frame) {
  rearrange(frame.depth, [&](int x, int y) { return std::pair(x, frame.depth.height() - 1 - y); });
}

/// The depth as a camera 2.5 cm to the right with a wider view measures it.
void unregister(Frame& frame) {
  constexpr float kBaseline = 0.025F;  // [m]
  constexpr float kZoom = 0.92F;
  const Image<float> right = frame.depth;
  const CameraIntrinsics& camera = *frame.calibration->camera;
  const auto focal = static_cast<float>(camera.fx) * kZoom;
  const float center_x = 0.5F * static_cast<float>(right.width());
  const float center_y = 0.5F * static_cast<float>(right.height());
  frame.depth = Image<float>(right.width(), right.height());
  for (int y = 0; y < right.height(); ++y) {
    for (int x = 0; x < right.width(); ++x) {
      const float d = right(x, y);
      if (d <= 0.0F) continue;
      const auto to_x = static_cast<int>(std::lround(
          center_x + (static_cast<float>(x) - center_x) * kZoom - kBaseline * focal / d));
      const auto to_y =
          static_cast<int>(std::lround(center_y + (static_cast<float>(y) - center_y) * kZoom));
      if (to_x < 0 || to_x >= right.width()) continue;
      float& there = frame.depth(to_x, to_y);
      if (there == 0.0F || d < there) there = d;
    }
  }
}

void change_camera(Frame& frame, void (*change)(CameraIntrinsics& camera)) {
  auto calibration = std::make_shared<Calibration>(*frame.calibration);
  change(*calibration->camera);
  frame.calibration = calibration;
}

void mirror_mask(Frame& frame) {
  const Image<std::uint8_t> right = frame.mask;
  for (int y = 0; y < right.height(); ++y) {
    for (int x = 0; x < right.width(); ++x) frame.mask(x, y) = right(right.width() - 1 - x, y);
  }
}

void swap_center(Frame& frame) {
  change_camera(frame, [](CameraIntrinsics& camera) { std::swap(camera.cx, camera.cy); });
}

void swap_focal_and_center(Frame& frame) {
  change_camera(frame, [](CameraIntrinsics& camera) {
    std::swap(camera.fx, camera.cx);
    std::swap(camera.fy, camera.cy);
  });
}

struct Mistake {
  const char* name;
  Change change;
  const char* expected;  ///< words in the fault
};

const Mistake kMistakes[] = {{"depth x 0.1", scale_depth<100>, "is the depth scale of"},
                             {"depth x 0.2", scale_depth<200>, "is the depth scale of"},
                             {"depth x 5", scale_depth<5000>, "is the depth scale of"},
                             {"depth x 10", scale_depth<10000>, "is the depth scale of"},
                             {"mirrored", mirror, "mirrored left to right"},
                             {"upside down", flip, "mirrored top to bottom"},
                             {"unregistered", unregister, "not registered"},
                             {"cx, cy swapped", swap_center, "far from the center"},
                             {"f, c swapped", swap_focal_and_center, "far from the center"}};

class PlausibleRecording : public testing::TestWithParam<const char*> {};

TEST_P(PlausibleRecording, RaisesNoAlarmAndEveryMistakeIsNoticed) {
  std::string data = GetParam();
  if (!data.starts_with("sim:")) {
    data = (fs::path(MMS_SOURCE_DIR) / "../shared/data/rgbd" / data).string();
    if (!fs::exists(data)) GTEST_SKIP() << data << " does not exist";
  }
  const Frames frames = frames_of(data);
  EXPECT_EQ(faults_of(frames), "");
  if (!data.starts_with("sim:")) {
    EXPECT_EQ(faults_of(frames_of(data, 4)), "") << "as mms run samples it";
  }
  for (const Mistake& mistake : kMistakes) {
    EXPECT_NE(faults_of(frames, mistake.change).find(mistake.expected), std::string::npos)
        << mistake.name << ": " << faults_of(frames, mistake.change);
  }
}

INSTANTIATE_TEST_SUITE_P(All, PlausibleRecording,
                         testing::Values("fr1_xyz_clip", "desk_crowd", "lab_crowd",
                                         "sim:warehouse_loop?hz=1&frames=8",
                                         "sim:still_walker?hz=1&frames=8",
                                         "sim:crowd?hz=1&frames=8", "sim:stop_and_go?hz=1&frames=8",
                                         "sim:corridor?hz=1&frames=8", "sim:static?hz=1&frames=8",
                                         "sim:fast?hz=1&frames=8", "sim:rack_aisle?hz=1&frames=8"));

class PlausibleSequence : public testing::TestWithParam<const char*> {};

TEST_P(PlausibleSequence, RaisesNoAlarmAndDelaysAreNoticed) {
  std::string data = GetParam();
  if (!data.starts_with("sim:")) {
    data = (fs::path(MMS_SOURCE_DIR) / "../shared/data/rgbd" / data).string();
    if (!fs::exists(data)) GTEST_SKIP() << data << " does not exist";
  }
  EXPECT_EQ(faults_in_sequence(sequence_of(data)), "");
  const Frames frames = sequence_of(data, RecordingCheck::kSequence + 6);
  for (const std::ptrdiff_t delay : {3, -3}) {
    const std::string faults = faults_in_sequence(delayed(frames, delay));
    const std::string expected = delay > 0 ? "behind" : "ahead of";
    EXPECT_NE(faults.find("ms) " + expected + " the color images"), std::string::npos)
        << delay << ": " << faults;
  }
}

INSTANTIATE_TEST_SUITE_P(All, PlausibleSequence,
                         testing::Values("fr1_xyz_clip", "desk_crowd", "lab_crowd",
                                         "sim:still_walker?frames=30", "sim:crowd?frames=30",
                                         "sim:fast?frames=30", "sim:rack_aisle?frames=30"));

/// With few edges in the depth, a delay may stay unnoticed.
TEST(RecordingCheck, RaisesNoAlarmForFewEdges) {
  for (const char* data : {"sim:corridor?seed=2&frames=80", "sim:stop_and_go?frames=30",
                           "sim:warehouse_loop?frames=30", "sim:static?frames=30"}) {
    EXPECT_EQ(faults_in_sequence(sequence_of(data)), "") << data;
  }
}

TEST(RecordingCheck, NoticesMasksOfOtherFramesAndMirroredOnes) {
  for (const char* data : {"sim:crowd?seed=42&frames=30", "sim:still_walker?seed=7&frames=30"}) {
    const Frames frames = sequence_of(data, RecordingCheck::kSequence + 6);
    EXPECT_EQ(faults_of(frames), "") << data;
    EXPECT_NE(faults_of(frames, mirror_mask).find("the masks are mirrored left to right"),
              std::string::npos)
        << data << ": " << faults_of(frames, mirror_mask);
    const std::string late = faults_in_sequence(delayed(frames, 0, 3));
    EXPECT_NE(late.find("the masks are 3 frames (200 ms) behind"), std::string::npos)
        << data << ": " << late;
  }
}

TEST(RecordingCheck, NoticesFrameRateTooLowForTheMotion) {
  const auto rate = [](const char* data) { return faults_in_sequence(sequence_of(data)); };
  EXPECT_NE(rate("sim:fast?hz=5&frames=16").find("of its width between frames, 200 ms apart"),
            std::string::npos)
      << rate("sim:fast?hz=5&frames=16");
  EXPECT_EQ(rate("sim:warehouse_loop?hz=5&frames=16"), "");
}

TEST(RecordingCheck, NoticesBlurredImages) {
  Frames frames = sequence_of("sim:warehouse_loop?frames=30");
  for (Frame& frame : frames) {
    const Image<Rgb> sharp = frame.color;
    for (int y = 0; y < sharp.height(); ++y) {
      for (int x = 12; x + 12 < sharp.width(); ++x) {
        int sum = 0;
        for (int dx = -12; dx <= 12; ++dx) sum += sharp(x + dx, y).g;
        const auto mean = static_cast<std::uint8_t>(sum / 25);
        frame.color(x, y) = {mean, mean, mean};
      }
    }
  }
  EXPECT_NE(faults_in_sequence(frames).find("the images are blurred"), std::string::npos)
      << faults_in_sequence(frames);
}

/// They are dark, which is another fault.
TEST(RecordingCheck, SeesNoMotionOfCoveredLens) {
  Frames frames = sequence_of("sim:warehouse_loop?frames=20");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (Rgb& color : frames[i].color.pixels()) {
      color = {0, static_cast<std::uint8_t>((i + color.g) % 3), 0};
    }
  }
  EXPECT_EQ(faults_in_sequence(frames), "");
}

/// Recordings that were not used to choose the limits.
TEST(RecordingCheck, NoticesMistakesInOtherScenes) {
  for (const char* data :
       {"sim:crowd?seed=42&hz=2&frames=8", "sim:warehouse_loop?seed=9&hz=2&frames=8"}) {
    const Frames frames = frames_of(data);
    EXPECT_EQ(faults_of(frames), "") << data;
    for (const Mistake& mistake : kMistakes) {
      EXPECT_NE(faults_of(frames, mistake.change).find(mistake.expected), std::string::npos)
          << data << ", " << mistake.name << ": " << faults_of(frames, mistake.change);
    }
  }
}

/// Its depth has edges of noise everywhere.
TEST(RecordingCheck, RaisesNoAlarmForNoisyDepth) {
  EXPECT_EQ(faults_of(frames_of("sim:crowd?seed=42&hz=2&frames=8&sensor=d435")), "");
}

TEST(RecordingCheck, NoticesEmptyAndConstantDepthAndDarkImages) {
  Frames frames = frames_of("sim:corridor?hz=1&frames=8");
  EXPECT_NE(faults_of(frames, [](Frame& f) { f.depth = Image<float>(640, 480); })
                .find("only 0 % of the depth pixels have a value"),
            std::string::npos);
  EXPECT_NE(faults_of(frames, [](Frame& f) { f.depth = Image<float>(640, 480, 2.5F); })
                .find("all depths are 2.5 m"),
            std::string::npos);
  EXPECT_NE(faults_of(frames,
                      [](Frame& f) {
                        f.color = Image<Rgb>(640, 480, Rgb{3, 3, 3});
                      })
                .find("the images are too dark: their mean is 3 of 255"),
            std::string::npos);
}

TEST(RecordingCheck, TakesNanAndInfinityForNoReturn) {
  const Frames frames = frames_of("sim:crowd?seed=5&hz=1&frames=8");
  EXPECT_EQ(faults_of(frames,
                      [](Frame& f) {
                        bool nan = false;
                        for (float& depth : f.depth.pixels()) {
                          if (depth > 0.0F) continue;
                          depth = nan ? std::nanf("") : INFINITY;
                          nan = !nan;
                        }
                      }),
            "");
}

TEST(RecordingCheck, AcceptsCamerasOfDataSets) {
  for (const CameraIntrinsics& camera :
       {CameraIntrinsics{517.3, 516.5, 318.6, 255.3, 640, 480, {}},
        CameraIntrinsics{600.0, 600.0, 599.5, 339.5, 1200, 680, {}},
        CameraIntrinsics{721.5, 721.5, 609.6, 172.9, 1242, 375, {}},
        CameraIntrinsics{320.0, 320.0, 320.0, 240.0, 640, 480, {}},
        CameraIntrinsics{585.0, 585.0, 320.0, 240.0, 640, 480, {}}}) {
    EXPECT_TRUE(camera_faults(camera).empty()) << camera_faults(camera).front();
  }
  EXPECT_EQ(camera_faults({525.0, 525.0, 319.5, 239.5, 1280, 960, {}}).size(), 1);
  EXPECT_EQ(camera_faults({525.0, 300.0, 319.5, 239.5, 640, 480, {}}).size(), 1);
  EXPECT_EQ(camera_faults({52.5, 52.5, 319.5, 239.5, 640, 480, {}}).size(), 1);
}

}  // namespace
}  // namespace mms
