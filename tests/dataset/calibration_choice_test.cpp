#include "mms/dataset/source/calibration_choice.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/ros/bag/bag_files.hpp"
#include "mms/ros/camera_messages.hpp"
#include "mms/ros/cloud_messages.hpp"
#include "mms/ros/image_messages.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

Frame first_frame(const TempFolder& folder, const CameraOptions& camera) {
  return Playback(open_dataset(folder.path(), {.camera = camera})).frames.at(0);
}

TEST(CalibrationChoice, FileReplacesThatOfTheFolder) {
  const TempFolder folder;
  write_tum(folder, 1);
  const auto file =
      folder.write("elsewhere/mine.yaml",
                   "fx: 20\nfy: 21\ncx: 4\ncy: 3\nwidth: 8\nheight: 6\ndepth_scale: 500\n");
  const Frame frame = first_frame(folder, {.file = file});
  EXPECT_EQ(frame.calibration->camera->fy, 21.0);
  EXPECT_EQ(frame.depth(0, 0), 3.0F);
  EXPECT_TRUE(any_has(open_dataset(folder.path(), {.camera = {.file = file}})->describe(),
                      "calibration: " + file.string()));
}

TEST(CalibrationChoice, IntrinsicsAndDepthScaleReplaceThoseOfTheFile) {
  const TempFolder folder;
  write_tum(folder, 1);
  const Frame frame =
      first_frame(folder, {.intrinsics = {{30, 31, 3.5, 2.5}}, .depth_scale = 750.0});
  EXPECT_EQ(frame.calibration->camera->fx, 30.0);
  EXPECT_EQ(frame.calibration->camera->cy, 2.5);
  EXPECT_EQ(frame.calibration->camera->width, kWidth);
  EXPECT_EQ(frame.depth(0, 0), 2.0F);
}

TEST(CalibrationChoice, IntrinsicsServeWhereThereIsNoFile) {
  const TempFolder folder;
  write_tum(folder, 1);
  std::filesystem::remove(folder.path() / "calibration.yaml");
  expect_in("give --calibration, or --intrinsics",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
  const Frame frame = first_frame(folder, {.intrinsics = {{30, 31, 3.5, 2.5}}});
  EXPECT_EQ(frame.calibration->camera->fy, 31.0);
  EXPECT_EQ(frame.depth(0, 0), 1.5F) << "1000 units per meter";
}

TEST(CalibrationChoice, OptionsOfImagesAreRejectedElsewhere) {
  const TempFolder folder;
  folder.write("000000.bin", std::string(16, '\0'));
  const auto error = [](const std::filesystem::path& data, const CameraOptions& camera) {
    return message_of<DataError>([&] { open_dataset(data, {.camera = camera}); });
  };
  expect_in("is no folder of color and depth images", error(folder.path(), {.depth_scale = 1.0}));
  expect_in("is a simulation and has its own camera", error("sim:static", {.depth_scale = 1.0}));
}

/// Extrinsics as RealSense's SDK writes them.
struct StreamTransform {
  static constexpr std::string_view kTypeName = "geometry_msgs/Transform";
  msg::Pose pose;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.pose);
  }
};

/// A bag with one frame.
class BagCalibration : public ::testing::Test {
 protected:
  template <class Message>
  void write(const std::string& topic, const Message& message) {
    bag_->write(topic, kStamp, message);
  }
  void color(const std::string& topic = "/rgb/image") {
    write(topic, image_message(kHeader, Image<Rgb>(kWidth, kHeight, {50, 0, 0})));
  }
  void depth(std::uint16_t value = 1500) {
    write("/depth/image", image_message(kHeader, Image<std::uint16_t>(kWidth, kHeight, value)));
  }
  void camera_info(const std::string& topic = "/rgb/camera_info") {
    write(topic, camera_info_message(kHeader, {10, 10, 4, 3, kWidth, kHeight, {}}));
  }
  void cloud() {
    LidarScan scan;
    scan.points = {{1, 2, 3}};
    write("/points", cloud_message({0, kStamp, "lidar"}, scan));
  }
  /// Images as RealSense's SDK records them, with depth in units of 0.25 mm, 1.5 m away.
  void realsense_images(const std::string& units = "Depth_Units") {
    color(kDevice + "sensor_1/Color_0/image/data");
    camera_info(kDevice + "sensor_1/Color_0/info/camera_info");
    const Image<std::uint16_t> raw(2 * kWidth, 2 * kHeight, 6000);
    msg::Image message = image_message(kHeader, raw);
    message.encoding = "mono16";
    write(kDepthStream + "image/data", message);
    write(kDevice + "sensor_0/option/" + units + "/value", msg::Float32{0.00025F});
    const CameraIntrinsics camera{20, 20, 8.5, 6.5, 2 * kWidth, 2 * kHeight, {}};
    write(kDepthStream + "info/camera_info", camera_info_message(kHeader, camera));
  }

  Playback play(const SourceOptions& options = {}) {
    if (bag_) bag_->finish();
    bag_.reset();
    return Playback(open_dataset(path_, options));
  }
  std::string error(const SourceOptions& options) {
    return message_of<DataError>([&] { play(options); });
  }

  static constexpr Timestamp kStamp{5'000'000'000};
  const msg::Header kHeader{0, kStamp, "0"};
  const std::string kDevice = "/device_0/";
  const std::string kDepthStream = kDevice + "sensor_0/Depth_0/";
  TempFolder folder_;
  std::filesystem::path path_ = folder_.path() / "a.bag";
  std::unique_ptr<BagWriter> bag_ = create_bag(path_);
};

TEST_F(BagCalibration, GivesUnitsOfIntegerDepth) {
  camera_info();
  color();
  depth();
  EXPECT_EQ(play().frames.at(0).depth(0, 0), 1.5F) << "millimeters without anything else";
  const Playback given = play({.camera = {.depth_scale = 2000.0}});
  EXPECT_EQ(given.frames.at(0).depth(0, 0), 0.75F);
  EXPECT_TRUE(any_has(given.source->describe(), "depth scale: given, 2000"));
  folder_.write("a.calibration.yaml",
                "fx: 10\nfy: 10\ncx: 4\ncy: 3\nwidth: 8\nheight: 6\ndepth_scale: 500\n");
  EXPECT_EQ(play().frames.at(0).depth(0, 0), 3.0F);
  EXPECT_EQ(play({.camera = {.depth_scale = 2000.0}}).frames.at(0).depth(0, 0), 0.75F);
  expect_in("--intrinsics is for those; use --calibration",
            error({.camera = {.intrinsics = {{10, 10, 4, 3}}}}));
}

TEST_F(BagCalibration, DepthInMetersHasNoScale) {
  camera_info();
  color();
  write("/depth/image", image_message(kHeader, Image<float>(kWidth, kHeight, 1.5F)));
  const Playback played = play({.camera = {.depth_scale = 2000.0}});
  EXPECT_EQ(played.frames.at(0).depth(0, 0), 1.5F);
  EXPECT_TRUE(any_has(played.warnings, "--depth-scale has no effect: the depth of /depth/image"));
}

TEST_F(BagCalibration, RejectsDepthScaleWithoutDepth) {
  cloud();
  expect_in("is read without depth images (omit --depth-scale)",
            error({.camera = {.depth_scale = 2000.0}}));
}

TEST_F(BagCalibration, MayHaveOtherFormats) {
  color();
  depth();
  const auto file = folder_.write("kalibr.yaml",
                                  "cam0:\n  camera_model: pinhole\n  intrinsics: [11, 12, 4, 3]\n"
                                  "  resolution: [8, 6]\n");
  const Playback played = play({.camera = {.file = file}});
  EXPECT_EQ(played.frames.at(0).calibration->camera->fy, 12.0);
  EXPECT_TRUE(any_has(played.source->describe(), "kalibr.yaml (Kalibr)"));
  EXPECT_TRUE(any_has(played.source->describe(), "depth scale: none, 1000 units per meter assum"));
}

TEST_F(BagCalibration, OfOtherFormatsLeavesExtrinsicsToTheBag) {
  color();
  cloud();
  msg::TransformStamped fixed{kHeader, "lidar", {}};
  fixed.transform.position = {0.25, 0, 0};
  write("/tf_static", msg::Transforms{{fixed}});
  const auto file = folder_.write("kalibr.yaml",
                                  "cam0:\n  camera_model: pinhole\n  intrinsics: [11, 12, 4, 3]\n"
                                  "  resolution: [8, 6]\n");
  const Playback played = play({.camera = {.file = file}});
  EXPECT_EQ(played.frames.at(0).calibration->T_camera_lidar.translation().x(), 0.25);
}

TEST_F(BagCalibration, RegistersDepthOfRealSense) {
  realsense_images();
  StreamTransform place;  // of a common reference in the frame of the stream
  place.pose.position = {0.25, 0, 0};
  write(kDepthStream + "tf/0", place);
  place.pose.position = {-0.05, 0, 0};
  write(kDevice + "sensor_1/Color_0/tf/0", place);
  const Playback played = play();
  EXPECT_TRUE(any_has(played.source->describe(), "depth scale: 4000 units per meter, by the opti"));
  EXPECT_TRUE(any_has(played.source->describe(), "and the extrinsics of RealSense's SDK"));
  ASSERT_EQ(played.frames.size(), 1U);
  for (int x = 0; x < kWidth; ++x) {  // 0.3 m are 2 px
    EXPECT_EQ(played.frames[0].depth(x, 2), x >= kWidth - 2 ? 0.0F : 1.5F) << x;
  }
}

TEST_F(BagCalibration, WarnsOfUnregisteredDepthOfRealSense) {
  realsense_images("Depth Units");  // as of earlier versions
  const Playback played = play();
  EXPECT_TRUE(any_has(played.source->describe(), "depth scale: 4000 units per meter, by the opti"));
  EXPECT_TRUE(any_has(played.warnings, "the bag has no extrinsics of both streams (tf/0)"));
  EXPECT_TRUE(played.frames.empty()) << "its size is another one";
}

TEST_F(BagCalibration, IsNotNeededForImagesBesideClouds) {
  color();
  cloud();
  const Playback played = play();
  ASSERT_EQ(played.frames.size(), 1U);
  EXPECT_EQ(played.frames[0].scan.points.size(), 1U);
  EXPECT_TRUE(played.frames[0].color.empty());
  EXPECT_FALSE(played.frames[0].calibration->camera);
  ASSERT_EQ(played.warnings.size(), 1U);
  expect_in("the images of /rgb/image are not used: ", played.warnings[0]);
  expect_in("has no sensor_msgs/CameraInfo for /rgb/image", played.warnings[0]);
  expect_in("has no sensor_msgs/CameraInfo", error({.topics = {.color = "/rgb/image"}}));
}

TEST_F(BagCalibration, OfFisheyeLeavesCloudsAlone) {
  color();
  cloud();
  msg::CameraInfo fisheye = camera_info_message(kHeader, {10, 10, 4, 3, kWidth, kHeight, {}});
  fisheye.distortion_model = "equidistant";
  fisheye.D = {0.1, 0.2, 0.3, 0.4};
  write("/rgb/camera_info", fisheye);
  const Playback played = play();
  EXPECT_EQ(played.frames.size(), 1U);
  ASSERT_EQ(played.warnings.size(), 1U);
  expect_in("has the distortion model 'equidistant'", played.warnings[0]);
}

}  // namespace
}  // namespace mms
