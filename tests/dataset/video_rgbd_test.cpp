#include <gtest/gtest.h>

#include <cstdlib>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/video/video_reader.hpp"
#include "tests/dataset/recording.hpp"
#include "tests/dataset/video_file.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

constexpr std::size_t kImages = 12;

/// Image i is of one color, 20 i. Its size is twice that of `kCalibration`.
std::vector<Image<Rgb>> make_images(int width = 2 * kWidth, int height = 2 * kHeight) {
  std::vector<Image<Rgb>> images;
  for (std::size_t i = 0; i < kImages; ++i) {
    const auto value = static_cast<std::uint8_t>(20 * i);
    images.emplace_back(width, height, Rgb{value, value, value});
  }
  return images;
}

/// Uneven times: 0, 40, 80, ... with one image missing after the fifth.
std::vector<Duration> make_times() {
  std::vector<Duration> times;
  for (std::size_t i = 0; i < kImages; ++i) {
    times.push_back(std::chrono::milliseconds(40 * (i < 5 ? i : i + 1)));
  }
  return times;
}

std::string number_name(std::size_t number) {
  const std::string digits = std::to_string(number);
  return std::string(6 - digits.size(), '0') + digits + ".png";
}

class VideoRgbd : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!kHasVideo) GTEST_SKIP() << "built without FFmpeg";
  }

  void write(std::size_t first_number = 0, std::size_t depth_images = kImages) {
    write_video(folder_.path() / "rgb.mkv", make_images(), make_times(), VideoCodec::kLossless);
    for (std::size_t i = 0; i < depth_images; ++i) {
      write_depth(folder_.path() / "depth" / number_name(first_number + i),
                  static_cast<std::uint16_t>(1000 + i));
    }
    folder_.write("calibration.yaml", kCalibration);
  }

  TempFolder folder_;
};

TEST_F(VideoRgbd, ReadsImagesAtTheirTimesWithDepthOfTheirNumber) {
  write();
  const Playback played(open_dataset(folder_.path()));
  ASSERT_EQ(played.frames.size(), kImages);
  EXPECT_TRUE(played.warnings.empty());
  for (std::size_t i = 0; i < kImages; ++i) {
    const Frame& frame = played.frames[i];
    EXPECT_EQ(frame.stamp, Timestamp() + make_times()[i]);
    EXPECT_EQ(frame.color.width(), kWidth);
    EXPECT_EQ(frame.color(3, 2).g, 20 * i);
    EXPECT_EQ(frame.depth(0, 0), static_cast<float>(1000 + i) / 1000.0F);
  }
  EXPECT_EQ(played.frames[0].name, "000000");
}

TEST_F(VideoRgbd, CountsDepthImagesFromOneIfTheLastNumberIsTheirCount) {
  write(1);
  const Playback played(open_dataset(folder_.path()));
  ASSERT_EQ(played.frames.size(), kImages);
  EXPECT_EQ(played.frames[3].color(0, 0).r, 60);
  EXPECT_EQ(played.frames[3].name, "000004");
}

TEST_F(VideoRgbd, WarnsOfFewDepthImages) {
  write(2, 5);
  const Playback played(open_dataset(folder_.path()));
  ASSERT_EQ(played.frames.size(), 5U);
  EXPECT_EQ(played.frames[0].color(0, 0).r, 40);
  EXPECT_TRUE(any_has(played.warnings, "has 5 depth images for 12 images of the video"));
}

TEST_F(VideoRgbd, MatchesStampsInNames) {
  write(0, 0);
  const std::int64_t begin = 1'700'000'000'000'000;  // [us]
  for (const std::int64_t ms : {0, 38, 219, 470}) {
    write_depth(folder_.path() / "depth" / (std::to_string(begin + 1000 * ms) + ".png"));
  }
  const Playback played(open_dataset(folder_.path()));
  ASSERT_EQ(played.frames.size(), 3U);  // 219 ms is in the gap between 160 and 240 ms: 21 ms off
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1000 * begin));
  EXPECT_EQ(played.frames[1].stamp, Timestamp(1000 * begin + 40'000'000));
  EXPECT_EQ(played.frames[1].depth_offset, std::chrono::milliseconds(-2));
  EXPECT_EQ(played.frames[2].color(0, 0).r, 220);
}

TEST_F(VideoRgbd, AcceptsCalibrationOfTheVideo) {
  write();
  folder_.write("calibration.yaml",
                "fx: 20\nfy: 20\ncx: 8.5\ncy: 6.5\nwidth: 16\nheight: 12\ndepth_scale: 1000\n");
  const CameraIntrinsics camera = *open_dataset(folder_.path())->calibration()->camera;
  EXPECT_EQ(camera, (CameraIntrinsics{10, 10, 4, 3, kWidth, kHeight, {}}));
}

TEST_F(VideoRgbd, ReadsStrayScanner) {
  write();
  std::filesystem::remove(folder_.path() / "calibration.yaml");
  folder_.write("camera_matrix.csv", "20.0, 0.0, 8.5\n0.0, 22.0, 6.5\n0.0, 0.0, 1.0\n");
  folder_.write("odometry.csv",
                "timestamp, frame, x, y, z, qx, qy, qz, qw\n"
                "71.50, 000000, 0, 0, 0, 0, 0, 0, 1\n"
                "71.54, 000001, 0.5, 0, 0, 0, 0, 0, 1\n");
  folder_.write("imu.csv",
                "timestamp, a_x, a_y, a_z, alpha_x, alpha_y, alpha_z\n"
                "71.50, 0, 0, -1, 0.1, 0, 0\n");
  const Playback played(open_dataset(folder_.path()));
  ASSERT_EQ(played.frames.size(), kImages);
  EXPECT_TRUE(played.frames[1].motion.empty());
  EXPECT_FALSE(any_has(played.warnings, "odometry.csv"));
  EXPECT_FALSE(any_has(played.warnings, "imu.csv"));
  EXPECT_TRUE(any_has(played.source->describe(), "layout: Stray Scanner"));
  EXPECT_EQ(played.frames[0].calibration->camera->fy, 11.0);
  EXPECT_EQ(played.frames[0].calibration->camera->cx, 4.0);
  const Trajectory& truth = played.source->ground_truth();
  ASSERT_EQ(truth.size(), 2U);
  EXPECT_EQ(truth[1].stamp, played.frames[1].stamp);
  EXPECT_EQ(truth[1].T_world_sensor.translation().x(), 0.5);
}

/// Of older versions of the app.
TEST_F(VideoRgbd, ReadsNumpyFilesOfStrayScannerInMillimeters) {
  const auto npy = [](const std::string& type, const auto& pixels) {
    const std::string header =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': (6, 8), }\n";
    return std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(header.size()) + '\0' + header +
           std::string(reinterpret_cast<const char*>(pixels.data()), sizeof(pixels));
  };
  std::array<std::uint16_t, 48> integers{};
  integers.fill(1250);
  std::array<float, 48> floats{};
  floats.fill(2500.0F);
  write(0, 0);
  folder_.write("depth/000000.npy", npy("<u2", integers));
  folder_.write("depth/000001.npy", npy("<f4", floats));
  std::filesystem::remove(folder_.path() / "calibration.yaml");
  folder_.write("camera_matrix.csv", "20.0, 0.0, 8.5\n0.0, 22.0, 6.5\n0.0, 0.0, 1.0\n");
  folder_.write("odometry.csv",
                "timestamp, frame, x, y, z, qx, qy, qz, qw\n"
                "71.50, 000000, 0, 0, 0, 0, 0, 0, 1\n");
  const Playback played(open_dataset(folder_.path()));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[0].depth(3, 3), 1.25F);
  EXPECT_EQ(played.frames[1].depth(3, 3), 2.5F);
}

TEST_F(VideoRgbd, ErrorsNameTheFault) {
  folder_.write("depth/readme.txt", "");
  folder_.write("x.mp4", "not a video");
  const auto message = [&] { return message_of<DataError>([&] { open_dataset(folder_.path()); }); };
  expect_in("x.mp4: cannot be read as a video", message());
  folder_.write("y.mp4", "another");
  expect_in("has several videos, as x.mp4 and y.mp4 (name the one of the color camera rgb.mp4)",
            message());
  write(0, 0);  // rgb.mkv is chosen
  expect_in("depth: has no depth images with numbers", message());
  write_png(folder_.path() / "depth/000000.png", Image<std::uint16_t>(8, 8, 1000));
  expect_in("a video of 16x12 pixels and depth images of 8x8", message());
}

TEST_F(VideoRgbd, ReadsImagesInAnyOrder) {
  for (const char* name : {"x.mp4", "x.mkv", "x.mov"}) {
    const auto path = folder_.path() / name;
    write_video(path, make_images(64, 48), make_times(), VideoCodec::kPredicted);
    VideoReader video(path);
    ASSERT_EQ(video.times(), make_times()) << name;
    for (const std::size_t i : {0, 1, 2, 7, 11, 3, 3, 10, 4, 5, 6, 7, 8, 0, 11}) {
      const Image<Rgb> image = video.read(i);
      ASSERT_EQ(image.width(), 64);
      EXPECT_NEAR(image(30, 20).r, static_cast<int>(20 * i), 4) << name << " image " << i;
    }
  }
}

TEST_F(VideoRgbd, SkipsImagesMissingFromTruncatedVideo) {
  write();
  const auto path = folder_.path() / "rgb.mkv";
  const std::string bytes = read_file(path);
  folder_.write("rgb.mkv", bytes.substr(0, bytes.size() * 3 / 4));
  const Playback played(open_dataset(folder_.path()));
  EXPECT_GT(played.frames.size(), 1U);
  EXPECT_LT(played.frames.size(), kImages);
}

}  // namespace
}  // namespace mms
