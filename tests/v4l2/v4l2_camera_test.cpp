#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "mms/dataset/camera/v4l2_pixels.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/recorder/frame_recorder.hpp"
#include "mms/io/config/calibration_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"

// Runs the program with the driver of a camera in driver/v4l2_camera.cpp, which plays images.

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using Words = std::vector<std::string>;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kFrames = 20;

/// Pairs of pixels have the mean of their colors.
Bytes yuyv_of(const Image<Rgb>& color) {
  Bytes bytes;
  const auto byte = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
  for (int y = 0; y < color.height(); ++y) {
    for (int x = 0; x + 1 < color.width(); x += 2) {
      double cb = 128.0, cr = 128.0, luma[2];
      for (int i = 0; i < 2; ++i) {
        const Rgb& c = color(x + i, y);
        luma[i] = 16.0 + (65.5 * c.r + 128.6 * c.g + 25.0 * c.b) / 255.0;
        cb += 0.5 * (-37.8 * c.r - 74.2 * c.g + 112.0 * c.b) / 255.0;
        cr += 0.5 * (112.0 * c.r - 93.8 * c.g - 18.2 * c.b) / 255.0;
      }
      bytes.insert(bytes.end(), {byte(luma[0]), byte(cb), byte(luma[1]), byte(cr)});
    }
  }
  return bytes;
}

Bytes z16_of(const Image<float>& depth) {
  Bytes bytes;
  for (const float meters : depth.pixels()) {
    const auto raw = static_cast<std::uint16_t>(std::lround(1000.0F * meters));
    bytes.push_back(static_cast<std::uint8_t>(raw & 0xFFU));
    bytes.push_back(static_cast<std::uint8_t>(raw >> 8));
  }
  return bytes;
}

/// Every second pixel of every second row, in whole millimeters.
Image<float> half_of(const Image<float>& depth) {
  Image<float> half(depth.width() / 2, depth.height() / 2);
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      half(x, y) = std::round(1000.0F * depth(2 * x, 2 * y)) / 1000.0F;
    }
  }
  return half;
}

/// Calibration of a depth camera of half the size at the place of the color camera.
Calibration calibration_of(CameraIntrinsics color) {
  color.distortion = {};
  Calibration calibration;
  calibration.camera = color;
  calibration.depth_scale = 1000.0;
  calibration.depth_camera = DepthCamera{{0.5 * color.fx,
                                          0.5 * color.fy,
                                          0.5 * color.cx,
                                          0.5 * color.cy,
                                          color.width / 2,
                                          color.height / 2,
                                          {}},
                                         {}};
  return calibration;
}

class V4l2Camera : public ::testing::Test {
 protected:
  /// Images of the camera in folder `images`, and in folder `recording` what must come of them.
  void write_images(bool compressed) {
    const auto source =
        open_dataset("sim:warehouse_loop?frames=" + std::to_string(kFrames), {.map_truth = false});
    const auto recorder = record_folder(path("recording"));
    std::string stamps;
    for (std::size_t i = 0; i < kFrames; ++i) {
      Frame frame = *source->next();
      const Calibration calibration = calibration_of(*frame.calibration->camera);
      const CameraIntrinsics& camera = *calibration.camera;
      const std::string name = std::to_string(i);
      const std::int64_t microseconds = frame.stamp.nanoseconds() / 1000;
      const Bytes color = compressed ? encode_jpeg(frame.color, 95) : yuyv_of(frame.color);
      frame.color = compressed
                        ? decode_color(color, name)
                        : color_from_yuyv(color, {camera.width, camera.height,
                                                  2 * static_cast<std::size_t>(camera.width)});
      frame.depth = half_of(frame.depth);
      const Bytes depth = z16_of(frame.depth);
      temp_.write("images/color/" + name, std::string(color.begin(), color.end()));
      temp_.write("images/depth/" + name, std::string(depth.begin(), depth.end()));
      stamps += std::to_string(microseconds) + "\n";
      frame.stamp = Timestamp(1000 * microseconds);
      frame.depth_offset = Duration(0);
      frame.mask = {};
      frame.calibration = std::make_shared<const Calibration>(calibration);
      recorder->add(frame);
      if (i > 0) continue;
      write_calibration(path("calibration.yaml"), calibration);
      temp_.write("images/camera.txt",
                  "depth 320 240 Z16\ncolor 640 480 " + std::string(compressed ? "MJPG" : "YUYV"));
    }
    recorder->finish({});
    temp_.write("images/stamps.txt", stamps);
  }

  void SetUp() override {
    ::setenv("LD_PRELOAD", MMS_V4L2_CAMERA, 1);
    ::setenv("MMS_TEST_V4L2", path("images").c_str(), 1);
    ::setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 0);
  }
  void TearDown() override {
    for (const char* name : {"LD_PRELOAD", "MMS_TEST_V4L2", "MMS_TEST_V4L2_FAULT"}) {
      ::unsetenv(name);
    }
  }
  static void set_fault(const char* fault) { ::setenv("MMS_TEST_V4L2_FAULT", fault, 1); }

  fs::path path(const std::string& name) const { return temp_.path() / name; }
  Outcome run(Words words) const { return run_mms(temp_.path(), words); }

  Outcome localize(const std::string& data, const std::string& output, Words more = {}) const {
    Words words = {"run", data, "--segmenter", "none", "-o", output};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  Outcome localize_live(const std::string& output, Words more = {}) const {
    more.insert(more.end(), {"--calibration", "calibration.yaml"});
    return localize("camera:v4l2", output, more);
  }

  std::string trajectory(const std::string& output) const {
    return read_file(path(output) / "trajectory.tum");
  }
  nlohmann::json metrics(const std::string& output) const {
    return nlohmann::json::parse(read_file(path(output) / "metrics.json"));
  }

  /// Poses are those of the recording, and of what was kept of the camera.
  void expect_poses_of_recording() {
    const Outcome live = localize_live("live", {"--record", "kept"});
    expect_success(live);
    EXPECT_EQ(lines_with(live, "camera:v4l2 was unplugged"), 1) << live.err;
    expect_in("MMS-SLAM V4L2 camera, 640x480, intrinsics from calibration.yaml", live.err);
    EXPECT_EQ(metrics("live")["realtime"]["frames_dropped"], 0);
    EXPECT_EQ(metrics("live")["frames"], kFrames);
    ::unsetenv("MMS_TEST_V4L2");
    expect_success(localize("recording", "recorded"));
    EXPECT_EQ(trajectory("live"), trajectory("recorded"));
    expect_success(localize("kept", "again"));
    EXPECT_EQ(trajectory("again"), trajectory("live"));
  }

  TempFolder temp_;
};

TEST_F(V4l2Camera, IsListed) {
  write_images(false);
  const Outcome text = run({"cameras"});
  expect_success(text);
  expect_in("camera:v4l2:0  MMS-SLAM V4L2 camera\n  uri    usb-0000:00:14.0-2\n", text.out);
  expect_in("mode   depth 320x240, 60/30 Hz, Z16, /dev/video0\n", text.out);
  expect_in("mode   color 640x480, 60/30 Hz, YUYV, /dev/video2\n", text.out);
  set_fault("no depth");
  expect_in("fault  has no depth images (Z16)", run({"cameras"}).out);
  set_fault("permission");
  expect_in("cannot be opened: Permission denied (its user must be in the group video",
            run({"cameras"}).out);
}

TEST_F(V4l2Camera, GivesPosesOfRecording) {
  write_images(false);
  expect_poses_of_recording();
}

TEST_F(V4l2Camera, GivesPosesOfRecordingWithCompressedColors) {
  write_images(true);
  expect_poses_of_recording();
}

TEST_F(V4l2Camera, LeavesDamagedImagesOut) {
  for (const bool compressed : {false, true}) {
    write_images(compressed);
    set_fault("damaged");
    expect_success(localize_live("live"));
    EXPECT_EQ(metrics("live")["frames"], kFrames - 3) << "images 3, 5 and 7";
    EXPECT_EQ(metrics("live")["realtime"]["frames_dropped"], 3);
    fs::remove_all(path("images"));
    fs::remove_all(path("recording"));
    fs::remove_all(path("live"));
  }
}

TEST_F(V4l2Camera, LeavesOutImageWhoseSizeIsWrong) {
  write_images(true);
  const Bytes small = encode_jpeg(Image<Rgb>(320, 240));
  temp_.write("images/color/9", std::string(small.begin(), small.end()));
  expect_success(localize_live("live"));
  EXPECT_EQ(metrics("live")["frames"], kFrames - 1);
  EXPECT_EQ(metrics("live")["realtime"]["frames_dropped"], 1);
}

TEST_F(V4l2Camera, GoesOnWithoutFramesUntilInterrupted) {
  write_images(false);
  set_fault("silent");
  RunningMms live(temp_.path(), {"run", "camera:v4l2", "--segmenter", "none", "-o", "live",
                                 "--calibration", "calibration.yaml"});
  const auto said = [&](const char* part) {
    return fs::exists(path(".stderr")) &&
           read_file(path(".stderr")).find(part) != std::string::npos;
  };
  for (int i = 0; i < 600 && !said("no frames arrive from camera:v4l2"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  live.send(SIGINT);
  expect_success(live.wait());
  EXPECT_EQ(metrics("live")["frames"], kFrames);
}

TEST_F(V4l2Camera, FaultsAreOneSentence) {
  write_images(false);
  expect_error(localize("camera:v4l2", "live"), "camera:v4l2: needs a calibration");
  expect_error(localize("camera:v4l2", "live", {"--intrinsics", "600,600,320,240"}),
               "has no depth images of 640x480 pixels in Z16");
  expect_error(localize("camera:v4l2:1", "live"), "the only camera has the index 0");
  expect_error(localize("camera:v4l2:/dev/video1", "live"), "no camera has this URI");
  const std::vector<std::pair<const char*, const char*>> faults = {
      {"busy",
       "/dev/video2: gives no images of 640x480, 30 Hz, YUYV: Device or resource busy "
       "(another program uses it)"},
      {"permission", "Permission denied (its user must be in the group video"},
      {"no depth", "camera:v4l2: has no depth images (Z16)"},
      {"no bandwidth", "the USB bus has no bandwidth left"}};
  for (const auto& [fault, message] : faults) {
    set_fault(fault);
    expect_error(localize_live("live"), message);
  }
  ::unsetenv("MMS_TEST_V4L2_FAULT");
  temp_.write("small.yaml",
              "fx: 300\nfy: 300\ncx: 160\ncy: 120\nwidth: 320\nheight: 240\ndepth_scale: 1000\n");
  expect_error(localize("camera:v4l2", "live", {"--calibration", "small.yaml"}),
               "has no color images of 320x240 pixels in YUYV or MJPG");
  ::unsetenv("MMS_TEST_V4L2");
  expect_error(localize_live("live"), "no camera was found");
  EXPECT_FALSE(fs::exists(path("live")));
}

}  // namespace
}  // namespace mms
