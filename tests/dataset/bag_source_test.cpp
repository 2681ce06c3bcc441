#include "mms/dataset/bag/bag_source.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/recorder/frame_recorder.hpp"
#include "mms/ros/bag/bag_files.hpp"
#include "mms/ros/camera_messages.hpp"
#include "mms/ros/cloud_messages.hpp"
#include "mms/ros/image_messages.hpp"
#include "tests/dataset/recording.hpp"
#include "tests/dataset/same_frame.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

constexpr Duration kMillisecond = std::chrono::milliseconds(1);
const CameraIntrinsics kCamera{10, 10, 4, 3, kWidth, kHeight, {}};

Timestamp at(int milliseconds) {
  return Timestamp(5'000'000'000) + kMillisecond * milliseconds;
}

class BagSources : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { bag_ = create_bag(path_); }

  msg::Header header(int milliseconds, const char* frame_id = "camera") const {
    return {0, at(milliseconds), frame_id};
  }
  template <class Message>
  void write(const std::string& topic, const Message& message) {
    bag_->write(topic, message.header.stamp + Duration(7), message);
  }
  void color(int milliseconds, std::uint8_t red = 50) {
    write("/rgb/image",
          image_message(header(milliseconds), Image<Rgb>(kWidth, kHeight, {red, 0, 0})));
  }
  void depth(int milliseconds, float metres = 1.5F) {
    write("/depth/image",
          image_message(header(milliseconds), Image<float>(kWidth, kHeight, metres)));
  }
  void camera_info() { write("/rgb/camera_info", camera_info_message(header(0), kCamera)); }

  void finish() {
    bag_->finish();
    bag_.reset();
  }
  Playback play(const SourceOptions& options = {}) {
    return Playback(open_dataset(path_, options));
  }
  std::string error(const SourceOptions& options = {}) {
    return message_of<DataError>([&] { open_dataset(path_, options); });
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_.path() / GetParam();
  std::unique_ptr<BagWriter> bag_;
};

TEST_P(BagSources, MatchesImagesByHeaderStamps) {
  camera_info();
  for (const int t : {0, 100, 200, 300}) color(t, static_cast<std::uint8_t>(t / 10));
  for (const int t : {12, 95, 190, 340}) depth(t, 1.0F + static_cast<float>(t) / 1000.0F);
  finish();
  const Playback played = play();
  ASSERT_EQ(played.frames.size(), 3U);
  EXPECT_EQ(played.names(), "5.000000000 5.100000000 5.200000000");
  EXPECT_EQ(played.frames[1].color(0, 0), (Rgb{10, 0, 0}));
  EXPECT_FLOAT_EQ(played.frames[1].depth(0, 0), 1.095F);
  EXPECT_EQ(played.frames[1].depth_offset, -5 * kMillisecond);
  EXPECT_EQ(*played.frames[1].calibration->camera, kCamera);
  EXPECT_TRUE(any_has(played.source->describe(), "3 matched within 0.02 s, 1 color images unma"));
  EXPECT_TRUE(any_has(played.source->describe(), "topic: /rgb/image, sensor_msgs/Image, 4 mess"));
  EXPECT_TRUE(any_has(played.source->describe(), "depth topic: /depth/image"));
}

TEST_P(BagSources, BringsWheelsAndGyroscopeWithTheirMounting) {
  camera_info();
  msg::Transforms tree;
  tree.transforms.resize(2);
  tree.transforms[0] = {header(0, "base_link"), "camera", {{0.2, 0, 1}, {-0.5, 0.5, -0.5, 0.5}}};
  tree.transforms[1] = {header(0, "base_link"), "imu_link", {{0.1, 0, 0.5}, {0, 0, 0, 1}}};
  bag_->write("/tf_static", at(0), tree);
  for (int t = 0; t <= 300; t += 20) {
    msg::Odometry odometry;
    odometry.header = header(t, "odom");
    odometry.child_frame_id = "base_link";
    odometry.pose.position = {0.001 * t, 0, 0};
    write("/odom", odometry);
    msg::Imu imu;
    imu.header = header(t, "imu_link");
    imu.angular_velocity = {0, 0, 0.01 * t};
    imu.linear_acceleration = {0, 0, 9.81};
    write("/imu", imu);
  }
  for (const int t : {100, 200}) color(t);
  for (const int t : {100, 200}) depth(t);
  finish();
  const Playback played = play();
  ASSERT_EQ(played.frames.size(), 2U);
  const Frame& second = played.frames[1];
  ASSERT_EQ(second.motion.wheels.size(), 5U);  // after 120 ms up to 220 ms
  ASSERT_EQ(second.motion.imu.size(), 5U);
  EXPECT_EQ(second.motion.wheels.back().stamp, at(220));
  EXPECT_NEAR(second.motion.wheels.back().T_odom_base.translation().x(), 0.22, 1e-12);
  EXPECT_NEAR(second.motion.imu.back().rate.z(), 2.2, 1e-12);
  EXPECT_NEAR(second.motion.imu.back().acceleration.z(), 9.81, 1e-12);
  const MotionCalibration& mounting = second.calibration->motion;
  ASSERT_TRUE(mounting.T_sensor_base);
  EXPECT_TRUE((mounting.T_sensor_base->rotation() * Eigen::Vector3d::UnitX())
                  .isApprox(Eigen::Vector3d::UnitZ(), 1e-9));
  ASSERT_TRUE(mounting.T_sensor_imu);
  EXPECT_TRUE(mounting.T_sensor_imu->translation().isApprox(Eigen::Vector3d(0, 0.5, -0.1), 1e-9));
  EXPECT_TRUE(any_has(played.source->describe(), "wheels: 16 measurements of /odom, 50 Hz"));
  EXPECT_TRUE(any_has(played.source->describe(), "gyroscope: 16 measurements of /imu, 50 Hz"));
  const Playback without = play({.motion = {.wheels = "none", .imu = "none"}});
  EXPECT_TRUE(without.frames[1].motion.empty());
}

TEST_P(BagSources, SkipsByIndex) {
  camera_info();
  for (int i = 0; i < 10; ++i) color(100 * i, static_cast<std::uint8_t>(i));
  for (int i = 0; i < 10; ++i) depth(100 * i);
  finish();
  const auto source = open_dataset(path_);
  source->skip(7);
  EXPECT_EQ(source->next()->color(0, 0).r, 7);
}

TEST_P(BagSources, UsesRecordTimeWithoutHeaderStamps) {
  camera_info();
  msg::Header none;
  bag_->write("/rgb/image", at(100), image_message(none, Image<Rgb>(kWidth, kHeight)));
  bag_->write("/depth/image", at(103), image_message(none, Image<float>(kWidth, kHeight)));
  finish();
  EXPECT_EQ(play().names(), "5.100000000");
}

TEST_P(BagSources, NoticesOtherClocks) {
  camera_info();
  LidarScan scan;
  scan.points = {{1, 2, 3}};
  bag_->write("/points", at(3000), cloud_message(header(0, "lidar"), scan));
  bag_->write("/rgb/image", at(5), image_message(header(0), Image<Rgb>(kWidth, kHeight)));
  finish();
  const Playback played = play();
  EXPECT_TRUE(any_has(played.source->describe(),
                      "clock: /points was recorded 3.000000000 s after its stamps"));
  EXPECT_TRUE(any_has(played.warnings, "the stamps of /rgb/image and /points have different"));
}

TEST_P(BagSources, SkipsAndReportsDamagedFrames) {
  camera_info();
  for (const int t : {0, 100, 200}) depth(t);
  color(0);
  write("/rgb/image", image_message(header(100), Image<Rgb>(4, 3)));
  msg::Image truncated = image_message(header(200), Image<Rgb>(kWidth, kHeight));
  truncated.data.resize(5);
  write("/rgb/image", truncated);
  finish();
  const Playback played = play();
  EXPECT_EQ(played.frames.size(), 1U);
  ASSERT_EQ(played.warnings.size(), 2U);
  expect_in("frame 5.100000000 skipped: " + GetParam() +
                ": /rgb/image message 1: is 4x3 pixels, its camera_info",
            played.warnings[0]);
  expect_in("/rgb/image message 2: has 5 bytes", played.warnings[1]);
}

TEST_P(BagSources, ReadsCompressedImages) {
  camera_info();
  const Image<std::uint16_t> raw(kWidth, kHeight, 1250);
  write("/rgb/image/compressed",
        compressed_message(header(0), Image<Rgb>(kWidth, kHeight, {90, 90, 90}), 95));
  write("/depth/image/compressedDepth", compressed_message(header(0), raw));
  finish();
  const Playback played = play();
  ASSERT_EQ(played.frames.size(), 1U);
  EXPECT_NEAR(played.frames[0].color(3, 3).g, 90, 3);
  EXPECT_EQ(played.frames[0].depth(3, 3), 1.25F);
}

TEST_P(BagSources, ReadsMasksAndGroundTruth) {
  camera_info();
  color(0);
  depth(0);
  write("/rgb/mask", image_message(header(0), Image<std::uint8_t>(kWidth, kHeight, 2)));
  msg::PoseStamped pose{header(0, "world"), {}};
  pose.pose.position = {1, 2, 3};
  write("/ground_truth", pose);
  finish();
  const Playback played = play();
  EXPECT_TRUE(played.source->has_masks());
  EXPECT_EQ(played.frames[0].mask(0, 0), 2);
  ASSERT_EQ(played.source->ground_truth().size(), 1U);
  EXPECT_EQ(played.source->ground_truth()[0].T_world_sensor.translation().z(), 3.0);
  EXPECT_FALSE(play({.load_masks = false}).source->has_masks());
}

TEST_P(BagSources, ReadsGroundTruthFromTransforms) {
  camera_info();
  color(0);
  depth(0);
  for (const int t : {0, 10}) {
    msg::TransformStamped moving{header(t, "/world"), "/kinect", {}};
    moving.transform.position = {1.0 + t, 0, 0};
    msg::TransformStamped fixed{header(t, "kinect"), "camera", {}};
    fixed.transform.position = {0.5, 0, 0};
    bag_->write("/tf", at(t), msg::Transforms{{moving, fixed}});
  }
  finish();
  EXPECT_TRUE(play().source->ground_truth().empty());
  const Playback played = play({.topics = {.truth = "/tf"}});
  ASSERT_EQ(played.source->ground_truth().size(), 2U);
  EXPECT_NEAR(played.source->ground_truth()[1].T_world_sensor.translation().x(), 11.5, 1e-12);
}

TEST_P(BagSources, RegistersDepthWithFrameOfItsOwn) {
  camera_info();
  color(0);
  write("/depth/image",
        image_message(header(0, "depth"), Image<float>(2 * kWidth, 2 * kHeight, 1.5F)));
  const CameraIntrinsics camera{20, 20, 8.5, 6.5, 2 * kWidth, 2 * kHeight, {}};
  write("/depth/camera_info", camera_info_message(header(0, "depth"), camera));
  msg::TransformStamped fixed{header(0, "camera"), "depth", {}};
  fixed.transform.position = {-0.3, 0, 0};  // 2 px to the left
  bag_->write("/tf_static", at(0), msg::Transforms{{fixed}});
  finish();
  const Playback played = play();
  ASSERT_EQ(played.frames.size(), 1U);
  EXPECT_TRUE(any_has(played.source->describe(),
                      "depth: registered to the color images by /depth/camera_info and the "
                      "transform from depth to camera"));
  for (int x = 0; x < kWidth; ++x) {
    EXPECT_EQ(played.frames[0].depth(x, 2), x >= kWidth - 2 ? 0.0F : 1.5F) << x;
  }
}

TEST_P(BagSources, WarnsOfDepthWithAFrameOfItsOwnAndNoTransform) {
  camera_info();
  color(0);
  write("/depth/image", image_message(header(0, "depth"), Image<float>(kWidth, kHeight, 1.5F)));
  finish();
  const Playback played = play();
  EXPECT_EQ(played.frames.size(), 1U);
  EXPECT_TRUE(any_has(played.warnings, "the depth of /depth/image is taken as registered"));
}

TEST_P(BagSources, RefusesDepthOfAnotherSizeWithoutTransform) {
  camera_info();
  color(0);
  write("/depth/image",
        image_message(header(0, "depth"), Image<float>(2 * kWidth, 2 * kHeight, 1.5F)));
  finish();
  const Playback played = play();
  EXPECT_TRUE(played.frames.empty());
  EXPECT_TRUE(any_has(played.warnings, "it must be registered to the color image"));
}

TEST_P(BagSources, ReadsCloudsWithCamera) {
  camera_info();
  LidarScan scan;
  scan.points = {{1, 2, 3}, {4, 5, 6}};
  scan.intensity = {1, 2};
  scan.time_offset = {0, 0.1F};
  for (const int t : {0, 100}) write("/points", cloud_message(header(t, "lidar"), scan));
  write("/points", cloud_message(header(200, "lidar"), LidarScan()));
  color(30);
  msg::TransformStamped fixed{header(0, "camera"), "lidar", {}};
  fixed.transform.position = {0.25, 0, 0};
  bag_->write("/tf_static", at(0), msg::Transforms{{fixed}});
  finish();
  const Playback played = play();
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[0].scan.points, scan.points);
  EXPECT_EQ(played.frames[0].scan.time_offset, scan.time_offset);
  EXPECT_FALSE(played.frames[0].color.empty());
  EXPECT_TRUE(played.frames[1].color.empty());
  EXPECT_EQ(played.frames[0].calibration->T_camera_lidar.translation().x(), 0.25);
  ASSERT_EQ(played.warnings.size(), 1U);
  expect_in("/points message 2: has no points", played.warnings[0]);
}

TEST_P(BagSources, ReadsScansOfLivox) {
  msg::LivoxScan scan;
  scan.points = {{0, {1, 2, 3}, 10, 16, 0}, {50'000'000, {4, 5, 6}, 200, 0, 1}};
  scan.point_num = 2;
  scan.timebase = 77;
  for (const int t : {0, 100}) {
    scan.header = header(t, "livox_frame");
    write("/livox/lidar", scan);
  }
  finish();
  const Playback played = play();
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[1].stamp, at(100));
  const LidarScan& second = played.frames[1].scan;
  EXPECT_EQ(second.points, (std::vector<Eigen::Vector3f>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(second.intensity, (std::vector<float>{10, 200}));
  EXPECT_EQ(second.time_offset, (std::vector<float>{0.0F, 0.05F}));
  EXPECT_TRUE(played.warnings.empty());
}

TEST_P(BagSources, MasksOfCloudsAreThoseOfTheirImages) {
  camera_info();
  LidarScan scan;
  scan.points = {{1, 2, 3}};
  for (const int t : {0, 100, 200}) write("/points", cloud_message(header(t, "lidar"), scan));
  for (const int t : {30, 130}) color(t);
  for (const int t : {30, 130, 200}) {  // the last one without an image
    write("/rgb/mask", image_message(header(t), Image<std::uint8_t>(kWidth, kHeight, 2)));
  }
  finish();
  const Playback played = play();
  ASSERT_EQ(played.frames.size(), 3U);
  EXPECT_TRUE(played.source->has_masks());
  for (const std::size_t i : {0U, 1U}) {
    ASSERT_FALSE(played.frames[i].mask.empty()) << i;
    EXPECT_EQ(played.frames[i].mask(0, 0), 2) << i;
  }
  EXPECT_TRUE(played.frames[2].mask.empty());
  EXPECT_TRUE(any_has(played.source->describe(), "masks: 2 of 3 in /rgb/mask"));
}

TEST_P(BagSources, WarnsOncePerRecordingOfPointTimesOfAnotherClock) {
  LidarScan scan;
  scan.points = {{1, 2, 3}, {4, 5, 6}};
  scan.time_offset = {51.5F, 51.75F};  // since the start of the sensor
  for (const int t : {0, 100}) write("/points", cloud_message(header(t, "lidar"), scan));
  finish();
  const Playback played = play();
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[1].scan.time_offset, (std::vector<float>{0.0F, 0.25F}));
  ASSERT_EQ(played.warnings.size(), 1U);
  expect_in("the times of points of /points are more than 1 s from the stamps", played.warnings[0]);
}

TEST_P(BagSources, CalibrationFileReplacesCameraInfo) {
  color(0);
  depth(0);
  finish();
  expect_in(
      "has no sensor_msgs/CameraInfo for /rgb/image; it has /depth/image sensor_msgs/Image (1)",
      error());
  expect_in("add the camera to a.calibration.yaml", error());
  folder_.write("a.calibration.yaml", kCalibration);
  EXPECT_EQ(play().frames.size(), 1U);
}

TEST_P(BagSources, ErrorListsMissingDataAndTopics) {
  color(0);
  finish();
  expect_in("has neither color images with depth nor point clouds; it has /rgb/image", error());
  bag_ = create_bag(path_);
  finish();
  expect_in(GetParam() + ": is empty: it has no topics", error());
  bag_ = create_bag(path_);
  camera_info();
  color(0);
  depth(500);
  finish();
  expect_in("no two match within 0.02 s (they begin at 5.000000000 and 5.5", error());
  expect_in("has no mask for any frame", [&] {
    bag_ = create_bag(path_);
    camera_info();
    color(0);
    depth(0);
    finish();
    return error({.masks = folder_.path()});
  }());
}

TEST_P(BagSources, RejectsTopicsForFolders) {
  finish();
  write_tum(folder_, 1);
  expect_in("is not a bag and has no topics", message_of<DataError>([&] {
              open_dataset(folder_.path(), {.topics = {.color = "/a"}});
            }));
}

void expect_same_frames(const std::filesystem::path& a, const std::filesystem::path& b) {
  const Playback first(open_dataset(a));
  const Playback second(open_dataset(b));
  ASSERT_EQ(first.frames.size(), second.frames.size());
  ASSERT_FALSE(first.frames.empty());
  for (std::size_t i = 0; i < first.frames.size(); ++i) {
    Frame frame = second.frames[i];
    frame.name = first.frames[i].name;
    auto calibration = std::make_shared<Calibration>(*frame.calibration);
    calibration->depth_scale = first.frames[i].calibration->depth_scale;
    EXPECT_TRUE(calibration->T_camera_lidar.isometry().isApprox(
        first.frames[i].calibration->T_camera_lidar.isometry(), 1e-12));  // bags have quaternions
    calibration->T_camera_lidar = first.frames[i].calibration->T_camera_lidar;
    frame.calibration = calibration;
    expect_same_frame(first.frames[i], frame);
  }
  EXPECT_EQ(first.source->ground_truth().size(), second.source->ground_truth().size());
}

void record(const std::filesystem::path& from, FrameRecorder& recorder) {
  const auto source = open_dataset(from);
  while (const auto frame = source->next()) recorder.add(*frame);
  recorder.finish(source->ground_truth());
}

TEST_P(BagSources, ConvertsToBagAndBackWithoutLoss) {
  for (const std::string sensor : {"d435", "l515", "kinect", "lidar16"}) {
    const std::string scene = "sim:crowd?frames=3&width=64&sensor=" + sensor;
    const auto bag = folder_.path() / (sensor + GetParam());
    const auto back = folder_.path() / sensor;
    record(scene, *record_bag(bag, false));
    expect_same_frames(scene, bag);
    record(bag, *record_folder(back));
    expect_same_frames(scene, back);
  }
}

TEST_P(BagSources, RecordsWheelsAndGyroscope) {
  bag_.reset();
  const std::string scene =
      "sim:crowd?frames=3&width=64&wheels.enabled=true&imu.enabled=true&sensor=d435";
  const std::filesystem::path bag = folder_.path() / ("motion" + GetParam());
  record(scene, *record_bag(bag, false));
  const Playback a(open_dataset(scene));
  const Playback b(open_dataset(bag));
  ASSERT_EQ(a.frames.size(), b.frames.size());
  const MotionSamples& before = a.frames[1].motion;
  const MotionSamples& after = b.frames[1].motion;
  ASSERT_FALSE(before.wheels.empty());
  ASSERT_EQ(before.wheels.size(), after.wheels.size());
  ASSERT_EQ(before.imu.size(), after.imu.size());
  EXPECT_EQ(before.imu.front().stamp, after.imu.front().stamp);
  EXPECT_TRUE(before.imu.front().rate.isApprox(after.imu.front().rate, 1e-12));
  EXPECT_TRUE(a.frames[1].calibration->motion.T_sensor_base->isometry().isApprox(
      b.frames[1].calibration->motion.T_sensor_base->isometry(), 1e-9));
}

TEST(FolderRecorder, KeepsDepthBeyond13Meters) {
  const TempFolder folder;
  Frame frame;
  auto calibration = std::make_shared<Calibration>();
  calibration->camera = kCamera;
  frame.calibration = calibration;
  frame.color = Image<Rgb>(kWidth, kHeight);
  frame.depth = Image<float>(kWidth, kHeight, 20.12345F);
  const auto recorder = record_folder(folder.path() / "a");
  recorder->add(frame);
  recorder->finish({});
  const Playback played(open_dataset(folder.path() / "a"));
  EXPECT_NEAR(played.frames.at(0).depth(0, 0), 20.123F, 1e-3F);
}

/// What a recorder that is killed leaves.
TEST(FolderRecorder, HasFramesSoFarBeforeItsEnd) {
  for (const std::string sensor : {"d435", "lidar16"}) {
    const TempFolder folder;
    const auto source = open_dataset("sim:crowd?frames=3&width=64&sensor=" + sensor);
    const auto recorder = record_folder(folder.path() / sensor);
    for (std::size_t count = 1; count < 3; ++count) {
      recorder->add(*source->next());
      const Playback played(open_dataset(folder.path() / sensor));
      EXPECT_EQ(played.frames.size(), count) << sensor;
      EXPECT_TRUE(played.warnings.empty()) << sensor << played.warnings.front();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, BagSources, ::testing::Values("a.bag", "a.mcap"),
                         [](const auto& format) { return format.param.substr(2); });

}  // namespace
}  // namespace mms
