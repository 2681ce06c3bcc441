#include "mms/run/repeated_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace mms {
namespace {

/// An RGB-D frame every 66 ms whose images depend on two numbers.
Frame frame_of(int index, int color, int depth) {
  Frame frame;
  frame.index = index;
  frame.stamp = Timestamp::from_seconds(0.066 * index);
  frame.color = Image<Rgb>(8, 6);
  frame.depth = Image<float>(8, 6);
  for (std::size_t i = 0; i < frame.color.size(); ++i) {
    frame.color[i] = {static_cast<std::uint8_t>(color), static_cast<std::uint8_t>(i), 0};
    frame.depth[i] = 1.0F + 0.001F * static_cast<float>(depth) * static_cast<float>(i);
  }
  frame.depth[3] = std::numeric_limits<float>::quiet_NaN();
  return frame;
}

/// Indices of the frames that are left.
std::vector<std::int64_t> left_of(std::vector<Frame> frames) {
  RepeatedFrames repeated;
  std::vector<std::int64_t> left;
  for (Frame& frame : frames) {
    if (!repeated.omits(frame)) left.push_back(frame.index);
  }
  EXPECT_EQ(repeated.count(), frames.size() - left.size());
  return left;
}

using Indices = std::vector<std::int64_t>;

TEST(RepeatedFrames, BothImages) {
  EXPECT_EQ(left_of({frame_of(0, 1, 1), frame_of(1, 1, 1), frame_of(2, 1, 1), frame_of(3, 2, 2)}),
            (Indices{0, 3}));
}

TEST(RepeatedFrames, OneImageOfASlowerCamera) {
  EXPECT_EQ(left_of({frame_of(0, 1, 1), frame_of(1, 1, 2), frame_of(2, 2, 3), frame_of(3, 3, 3)}),
            (Indices{0, 2}));
}

TEST(RepeatedFrames, DepthGoesOnWithoutABrokenColorCamera) {
  RepeatedFrames repeated;
  Indices left;
  for (int i = 0; i < 8; ++i) {
    Frame frame = frame_of(i, i < 7 ? 1 : 2, i);
    if (repeated.omits(frame)) continue;
    left.push_back(i);
    EXPECT_EQ(frame.color.empty(), i >= 4 && i < 7) << i;
    EXPECT_EQ(repeated.has_old_color(), frame.color.empty()) << i;
  }
  EXPECT_EQ(left, (Indices{0, 4, 5, 6, 7}));
}

TEST(RepeatedFrames, SaysSoOnce) {
  RepeatedFrames repeated;
  std::vector<std::string> lines;
  for (int i = 0; i < 8; ++i) {
    Frame frame = frame_of(i, 1, i);
    frame.name = std::to_string(i);
    repeated.omits(frame, [&](const std::string& line) { lines.push_back(line); });
  }
  EXPECT_EQ(lines,
            (std::vector<std::string>{
                "frame 1: repeats an image or scan of the frame before: such frames are left out",
                "frame 4: the color image does not change any more: the depth is used alone"}));
}

TEST(RepeatedFrames, ABrokenDepthCameraDoes) {
  std::vector<Frame> frames;
  for (int i = 0; i < 7; ++i) frames.push_back(frame_of(i, i, 1));
  EXPECT_EQ(left_of(std::move(frames)), (Indices{0}));
}

TEST(RepeatedFrames, ABrokenSensorRepeatsForever) {
  std::vector<Frame> frames;
  for (int i = 0; i < 12; ++i) frames.push_back(frame_of(i, 1, 1));
  EXPECT_EQ(left_of(std::move(frames)), (Indices{0}));
}

TEST(RepeatedFrames, BlackImagesInTheDark) {
  std::vector<Frame> frames = {frame_of(0, 0, 1), frame_of(1, 0, 2), frame_of(2, 0, 3)};
  for (Frame& frame : frames) frame.color = Image<Rgb>(8, 6);
  EXPECT_EQ(left_of(std::move(frames)), (Indices{0, 1, 2}));
}

TEST(RepeatedFrames, ACoveredCamera) {
  std::vector<Frame> frames = {frame_of(0, 1, 1), frame_of(1, 1, 1), frame_of(2, 1, 1)};
  for (Frame& frame : frames) frame.depth = Image<float>(8, 6);
  EXPECT_EQ(left_of(std::move(frames)), (Indices{0, 1, 2}));
}

TEST(RepeatedFrames, OnePixelDiffers) {
  std::vector<Frame> frames = {frame_of(0, 1, 1), frame_of(1, 1, 1)};
  frames[1].color[5].b = 1;
  frames[1].depth[40] += 0.001F;
  EXPECT_EQ(left_of(std::move(frames)), (Indices{0, 1}));
}

TEST(RepeatedFrames, Scans) {
  std::vector<Frame> frames(4);
  for (int i = 0; i < 4; ++i) {
    frames[static_cast<std::size_t>(i)].index = i;
    frames[static_cast<std::size_t>(i)].scan.points = {{1, 2, 3}, {4, 5, i < 2 ? 6.0F : 7.0F}};
    frames[static_cast<std::size_t>(i)].color = Image<Rgb>(8, 6);  // of a slower camera
  }
  frames[3].scan.points.clear();
  EXPECT_EQ(left_of(std::move(frames)), (Indices{0, 2, 3}));
}

TEST(RepeatedFrames, TheNextFrameGetsMotionAndPlace) {
  RepeatedFrames repeated;
  std::vector<Frame> frames = {frame_of(0, 1, 1), frame_of(1, 1, 1), frame_of(2, 1, 1),
                               frame_of(3, 2, 2)};
  for (Frame& frame : frames) {
    frame.motion.imu.push_back({frame.stamp});
    frame.motion.wheels.push_back({frame.stamp, {}});
  }
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translation().x() = 2.0;
  frames[1].expected_place = Transform<Global, Sensor>(place);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(repeated.omits(frames[i]), i == 1 || i == 2);
  ASSERT_EQ(frames[3].motion.imu.size(), 3U);
  ASSERT_EQ(frames[3].motion.wheels.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(frames[3].motion.imu[i].stamp, frames[i + 1].stamp);
    EXPECT_EQ(frames[3].motion.wheels[i].stamp, frames[i + 1].stamp);
  }
  ASSERT_TRUE(frames[3].expected_place);
  EXPECT_EQ(frames[3].expected_place->isometry().translation().x(), 2.0);
}

}  // namespace
}  // namespace mms
