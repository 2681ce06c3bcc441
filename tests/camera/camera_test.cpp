#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/recorder/frame_recorder.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"

// Runs the program with OpenNI2, whose driver in driver/recording_driver.cpp plays a recording.

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using Words = std::vector<std::string>;

constexpr int kFrames = 20;
constexpr const char* kIntrinsics = "605,605,321.4,243.2";

/// A recording of 640x480 pixels with depth in millimeters and stamps in microseconds, as cameras
/// have them.
void write_recording(const fs::path& folder) {
  const auto source =
      open_dataset("sim:warehouse_loop?frames=" + std::to_string(kFrames), {.map_truth = false});
  const auto recorder = record_folder(folder);
  while (std::optional<Frame> frame = source->next()) {
    Calibration calibration = *frame->calibration;
    calibration.depth_scale = 1000.0;
    calibration.camera->distortion = {};
    calibration.max_depth.reset();
    frame->calibration = std::make_shared<const Calibration>(calibration);
    for (std::size_t i = 0; i < frame->depth.size(); ++i) {
      frame->depth[i] = std::round(1000.0F * frame->depth[i]) / 1000.0F;
    }
    frame->stamp = Timestamp(frame->stamp.nanoseconds() / 1000 * 1000);
    frame->depth_offset = Duration(0);
    frame->mask = {};
    recorder->add(*frame);
  }
  recorder->finish({});
}

class Camera : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    recording() = fs::temp_directory_path() / ("mms_camera_" + std::to_string(::getpid()));
    fs::remove_all(recording());
    write_recording(recording());
  }
  static void TearDownTestSuite() { fs::remove_all(recording()); }
  static fs::path& recording() {
    static fs::path folder;
    return folder;
  }

  void SetUp() override {
    ::setenv("LD_LIBRARY_PATH", MMS_OPENNI2_FOLDER, 1);
    ::setenv("MMS_TEST_CAMERA", recording().c_str(), 1);
    // Slow enough for a machine under load: OpenNI2 keeps only the last image.
    ::setenv("MMS_TEST_CAMERA_PERIOD", "100", 1);
  }
  void TearDown() override {
    for (const char* name : {"LD_LIBRARY_PATH", "MMS_TEST_CAMERA", "MMS_TEST_CAMERA_PERIOD",
                             "MMS_TEST_CAMERA_FAULT"}) {
      ::unsetenv(name);
    }
  }

  static void set_fault(const char* fault) { ::setenv("MMS_TEST_CAMERA_FAULT", fault, 1); }

  Outcome run(Words words) const { return run_mms(temp_.path(), words); }

  /// Runs on a recording or camera, with results in `output`.
  Outcome localize(const std::string& data, const std::string& output, Words more = {}) const {
    Words words = {"run", data, "--segmenter", "none", "-o", output};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }

  std::string trajectory(const std::string& output) const {
    return read_file(temp_.path() / output / "trajectory.tum");
  }
  nlohmann::json metrics(const std::string& output) const {
    return nlohmann::json::parse(read_file(temp_.path() / output / "metrics.json"));
  }

  TempFolder temp_;
};

TEST_F(Camera, IsListed) {
  const Outcome text = run({"cameras"});
  expect_success(text);
  expect_in("camera:openni2:0  MMS-SLAM Recorded camera", text.out);
  expect_in("mode   color 640x480, 30 Hz, RGB888", text.out);
  expect_in("mode   depth 640x480, 30 Hz, 1 mm", text.out);
  const auto json = nlohmann::json::parse(run({"cameras", "--json"}).out);
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json[0]["uri"], "recording:0");
  EXPECT_EQ(json[0]["modes"].size(), 2U);

  set_fault("busy");
  expect_in("cannot be opened: the device is used by another program", run({"cameras"}).out);
  ::unsetenv("MMS_TEST_CAMERA");
  const Outcome none = run({"cameras"});
  expect_success(none);
  expect_in("no camera was found", none.out);
  EXPECT_EQ(run({"cameras", "--json"}).out, "[]\n");
}

/// Frames that arrived before the run do not count.
TEST_F(Camera, RunsInRealTime) {
  expect_success(localize("camera:openni2", "live", {"--realtime", "--frames", "3"}));
  EXPECT_FALSE(trajectory("live").empty());
}

TEST_F(Camera, TakesNameOfNetwork) {
  expect_success(
      run({"run", "camera:openni2", "--weights", "nano", "--frames", "3", "-o", "named"}));
  expect_in("nano.safetensors", read_file(temp_.path() / "named/config.yaml"));
}

TEST_F(Camera, GivesPosesOfRecordingAndEndsWhenUnplugged) {
  expect_success(localize(recording(), "recorded"));
  const Outcome live =
      localize("camera:openni2", "live", {"--intrinsics", kIntrinsics, "--record", "kept"});
  expect_success(live);
  EXPECT_EQ(lines_with(live, "camera:openni2 was unplugged"), 1) << live.err;
  expect_in("intrinsics from --intrinsics (fx 605.0", live.err);
  const auto realtime = metrics("live")["realtime"];
  ASSERT_EQ(realtime["frames_dropped"], 0) << "the machine is too slow for this test";
  EXPECT_GT(realtime["latency_s"]["mean"], 0.0);
  EXPECT_EQ(metrics("live")["frames"], kFrames);
  EXPECT_TRUE(metrics("recorded").value("realtime", nlohmann::json()).is_null());
  EXPECT_EQ(trajectory("live"), trajectory("recorded"));
  // What was kept gives the same again.
  expect_success(localize("kept", "again"));
  EXPECT_EQ(trajectory("again"), trajectory("live"));
}

TEST_F(Camera, TakesIntrinsicsFromFieldOfViewAndUndoesMirroring) {
  set_fault("mirrored");
  const Outcome live = localize("camera:openni2:recording:0", "live", {"--record", "kept"});
  expect_success(live);
  expect_in("intrinsics from its field of view (fx 605.0, fy 605.0, cx 319.5, cy 239.5)", live.err);
  ASSERT_EQ(metrics("live")["realtime"]["frames_dropped"], 0);
  expect_success(localize("kept", "again"));
  EXPECT_EQ(trajectory("again"), trajectory("live"));
  const auto kept = open_dataset(temp_.path() / "kept")->next();
  const auto original = open_dataset(recording())->next();
  EXPECT_EQ(kept->color.pixels(), original->color.pixels());
  EXPECT_EQ(kept->depth.pixels(), original->depth.pixels());
}

TEST_F(Camera, EndsAfterFrames) {
  expect_success(localize("camera:openni2", "live", {"--frames", "5", "--record", "kept"}));
  EXPECT_EQ(metrics("live")["frames"], 5);
  EXPECT_GE(open_dataset(temp_.path() / "kept")->size(), 5U);
}

TEST_F(Camera, SkippedFramesAreNotCounted) {
  expect_success(localize("camera:openni2", "live", {"--start", "3", "--frames", "5"}));
  EXPECT_EQ(metrics("live")["frames"], 5);
  const Outcome outcome = localize("camera:openni2", "all", {"--start", "3"});
  expect_success(outcome);
  expect_in("camera:openni2, until Ctrl-C", outcome.err);
}

TEST_F(Camera, GoesOnWithoutFramesUntilInterrupted) {
  set_fault("silent");
  RunningMms live(temp_.path(), {"run", "camera:openni2", "--segmenter", "none", "-o", "live",
                                 "--record", "kept"});
  const auto said = [&](const char* part) {
    const fs::path log = temp_.path() / ".stderr";
    return fs::exists(log) && read_file(log).find(part) != std::string::npos;
  };
  for (int i = 0; i < 600 && !said("no frames arrive from camera:openni2"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  live.send(SIGINT);
  const Outcome outcome = live.wait();
  expect_success(outcome);
  EXPECT_GE(lines_with(outcome, "color images: none received; depth images: none received"), 1);
  EXPECT_EQ(metrics("live")["frames"], kFrames);
  EXPECT_EQ(open_dataset(temp_.path() / "kept")->size(), static_cast<std::size_t>(kFrames));
}

TEST_F(Camera, FaultsAreOneSentence) {
  const std::vector<std::pair<const char*, const char*>> faults = {
      {"busy", "cannot be opened: the device is used by another program"},
      {"no color", "has no color images"},
      {"no mode", "has no color images of 640x480 pixels, RGB888"},
      {"no registration", "does not register its depth images"}};
  for (const auto& [fault, message] : faults) {
    set_fault(fault);
    expect_error(localize("camera:openni2", "live"), std::string("camera:openni2: ") + message);
  }
  ::unsetenv("MMS_TEST_CAMERA_FAULT");
  expect_error(localize("camera:openni2:1", "live"), "the only camera has the index 0");
  expect_error(localize("camera:openni2:usb", "live"), "no camera has this URI");
  expect_error(localize("camera:kinect", "live"), "is no camera that is known");
  expect_error(localize("camera:openni2", "live", {"--depth-scale", "1000"}), "--depth-scale");
  expect_error(run({"info", "camera:openni2"}), "is a camera, not a recording");
  expect_usage_error(localize("camera:openni2", "live", {"--masks", "."}), "--masks");
  expect_usage_error(localize(recording(), "live", {"--record", "kept"}), "--record");
  temp_.write("small.yaml",
              "fx: 300\nfy: 300\ncx: 160\ncy: 120\nwidth: 320\nheight: 240\ndepth_scale: 1000\n");
  expect_error(localize("camera:openni2", "live", {"--calibration", "small.yaml"}),
               "is for images of 320x240 pixels, those of camera:openni2 have 640x480");
  ::unsetenv("MMS_TEST_CAMERA");
  expect_error(localize("camera:openni2", "live"), "no camera was found");
  EXPECT_FALSE(fs::exists(temp_.path() / "live"));
  // A folder without drivers.
  const fs::path library = temp_.path() / "libOpenNI2.so.0";
  fs::create_symlink(fs::canonical(fs::path(MMS_OPENNI2_FOLDER) / library.filename()), library);
  fs::create_directories(temp_.path() / "OpenNI2/Drivers");
  ::setenv("LD_LIBRARY_PATH", temp_.path().c_str(), 1);
  expect_error(localize("camera:openni2", "live"), "OpenNI2: cannot start: ");
  expect_success(run({"--version"}));
}

class OniFile : public Camera {
 protected:
  /// The program tells of damage, or reads the rest, but does not crash as OpenNI2 does.
  void expect_survival_of_damage(const std::string& whole) {
    temp_.write("damaged.oni", "no recording, but of some length");
    expect_error(run({"info", "damaged.oni"}), "damaged.oni: is not a recording of OpenNI");
    const auto with = [&](const std::string& text, std::size_t offset, const std::string& bytes) {
      std::string damaged = whole;
      damaged.replace(whole.find(text) + offset, bytes.size(), bytes);
      temp_.write("damaged.oni", damaged);
      return run({"info", "damaged.oni"});
    };
    const std::string huge = "\xff\xff\xff\x7f";
    const std::string record("NIR\0", 4);
    expect_error(with("NI10", 20, huge), "at byte 20: has 2147483647 nodes");
    expect_error(with(record, 0, "NONE"), "at byte 24: no record begins there");
    expect_error(with(record, 8, huge), "at byte 24: a record of node 2147483647");
    expect_error(with(record, 12, huge), "at byte 24: a record of 2147483647 and 0 bytes");
    expect_error(with(record, 28, huge), "with 2147483647 bytes of data");
    expect_error(with("xnFOV", 0, "\xff"), "a record with a damaged name");
    // A record of another kind in place of the end of the properties.
    std::string end = record + "\t";
    end.resize(8);
    expect_error(with(end, 4, "\a"), "the properties of a node have no end before it");
    temp_.write("damaged.oni", whole.substr(0, whole.size() / 3));
    const Outcome cut = run({"info", "damaged.oni"});
    EXPECT_TRUE(cut.exit_code == 0 || cut.exit_code == 1) << cut.err;
  }
};

TEST_F(OniFile, GivesPosesOfRecording) {
  const std::string recorder =
      std::string(MMS_ONI_RECORDER) + " " + (temp_.path() / "x.oni").string();
  ASSERT_EQ(std::system(recorder.c_str()), 0);
  ::unsetenv("MMS_TEST_CAMERA");
  const Outcome info = run({"info", "x.oni"});
  expect_success(info);
  expect_in("layout: OpenNI\n", info.out);
  expect_in("frames: " + std::to_string(kFrames) + "\n", info.out);
  expect_success(localize("x.oni", "played", {"--intrinsics", kIntrinsics}));
  expect_success(localize(recording(), "recorded"));
  EXPECT_EQ(trajectory("played"), trajectory("recorded"));
  expect_success(run({"convert", "x.oni", "-o", "converted"}));
  EXPECT_EQ(open_dataset(temp_.path() / "converted")->size(), static_cast<std::size_t>(kFrames));
  expect_survival_of_damage(read_file(temp_.path() / "x.oni"));
}

}  // namespace
}  // namespace mms
