#include "mms/ros2/ros2_source.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "mms/geometry/depth_registration.hpp"
#include "mms/ros/camera_messages.hpp"
#include "mms/ros/cloud_messages.hpp"
#include "mms/ros/image_messages.hpp"

namespace mms {
namespace {

constexpr int kWidth = 8;
constexpr int kHeight = 6;

Timestamp at(double seconds) {
  return Timestamp::from_seconds(100.0 + seconds);
}

msg::Header header_at(double seconds, const std::string& frame) {
  return {0, at(seconds), frame};
}

/// A source in a graph with a robot that publishes to it.
class Ros2SourceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("ROS_LOCALHOST_ONLY", "1", 1);
    setenv("ROS_DOMAIN_ID", std::to_string(1 + getpid() % 100).c_str(), 1);
    options_.name_space = "test" + std::to_string(getpid());  // of parallel tests
    Ros2NodeOptions options = options_;
    options.name = "robot";
    robot_ = std::make_unique<Ros2Node>(options, [](const std::string&) {});
    color_ = add<msg::Image>("color");
    depth_ = add<msg::Image>("depth");
    camera_info_ = add<msg::CameraInfo>("camera_info");
    points_ = add<msg::PointCloud2>("points");
    depth_info_ = add<msg::CameraInfo>("depth_info");
    compressed_color_ = add<msg::CompressedImage>("color/compressed");
    compressed_depth_ = add<msg::CompressedImage>("depth/compressedDepth");
    imu_ = add<msg::Imu>("imu");
    wheels_ = add<msg::Odometry>("wheels");
    mask_ = add<msg::Image>("mask");
    initial_pose_ = add<msg::PoseWithCovarianceStamped>("initialpose");
    tf_static_ = robot_->advertise<msg::Transforms>("/tf_static",
                                                    {TopicQos::Reliability::kReliable, true, 10});
  }

  void TearDown() override {
    source_.reset();  // stops the node
    node_.reset();
  }

  template <class Message>
  Ros2Writer add(const std::string& topic) {
    return robot_->advertise<Message>(topic, {TopicQos::Reliability::kReliable, false, 100});
  }

  /// Starts a source that gets what is published from then on.
  void start(const Ros2Inputs& inputs, const std::vector<Ros2Writer*>& used) {
    node_ = std::make_unique<Ros2Node>(
        options_, [this](const std::string& fault) { source_->count_damaged(fault); });
    source_ = std::make_unique<Ros2Source>(
        *node_, inputs, 100, [this] { return stop_.load(); }, [this] { went_back_ = true; });
    node_->every(0.02, [this, source = source_.get()] {
      const std::scoped_lock lock(report_mutex_);
      report_ = source->report();
    });
    node_->start();
    const auto all_wanted = [&] {
      return std::all_of(used.begin(), used.end(),
                         [](const Ros2Writer* writer) { return writer->is_wanted(); });
    };
    for (int i = 0; i < 1000 && !all_wanted(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_TRUE(all_wanted());
    stop_ = !all_wanted();  // no test waits for frames then
    // By then subscriptions have taken the reliability of the publishers.
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }

  void publish_images(double seconds) {
    camera_info_.publish(camera_info_message(header_at(seconds, "camera"), camera()));
    color_.publish(
        image_message(header_at(seconds, "camera"), Image<Rgb>(kWidth, kHeight, Rgb{1, 2, 3})));
    depth_.publish(
        image_message(header_at(seconds, "camera"), Image<float>(kWidth, kHeight, 2.0F)));
  }

  /// Whether the source says soon that this is missing.
  bool reports(const std::string& part) {
    for (int i = 0; i < 500; ++i) {
      {
        const std::scoped_lock lock(report_mutex_);
        if (report_.find(part) != std::string::npos) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }

  void publish_imu(double seconds) {
    msg::Imu message;
    message.header = header_at(seconds, "imu_link");
    message.angular_velocity = {seconds, 0.0, 0.0};
    imu_.publish(message);
  }

  static CameraIntrinsics camera() {
    CameraIntrinsics camera;
    camera.fx = camera.fy = 8.0;
    camera.cx = 3.5;
    camera.cy = 2.5;
    camera.width = kWidth;
    camera.height = kHeight;
    return camera;
  }

  static void ignore(const std::string&) {}

  Ros2NodeOptions options_;
  std::atomic<bool> stop_ = false;
  std::atomic<bool> went_back_ = false;  // the clock of the stamps
  std::mutex report_mutex_;
  std::string report_;  ///< the last one
  std::unique_ptr<Ros2Node> robot_, node_;
  std::unique_ptr<Ros2Source> source_;
  Ros2Writer color_, depth_, camera_info_, depth_info_, compressed_color_, compressed_depth_,
      points_, imu_, wheels_, mask_, initial_pose_, tf_static_;
};

TEST_F(Ros2SourceTest, ClockThatGoesBack) {
  start({.color = "color", .depth = "depth", .camera_info = "camera_info"},
        {&color_, &depth_, &camera_info_});
  publish_images(5.0);
  ASSERT_TRUE(source_->next());
  publish_images(4.5);  // late, but of the same clock
  publish_images(5.1);
  ASSERT_TRUE(source_->next());
  EXPECT_FALSE(went_back_);
  publish_images(0.0);
  for (int i = 0; i < 500 && !went_back_; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(went_back_);
}

TEST_F(Ros2SourceTest, GivesFramesOfImages) {
  start({.color = "color", .depth = "depth", .camera_info = "camera_info"},
        {&color_, &depth_, &camera_info_});
  for (const double seconds : {0.0, 0.1}) publish_images(seconds);
  ASSERT_TRUE(source_->wait(ignore));
  ASSERT_TRUE(source_->calibration());
  EXPECT_EQ(*source_->calibration()->camera, camera());
  EXPECT_EQ(source_->sensor_frame(), "camera");
  for (const double seconds : {0.0, 0.1}) {
    const auto frame = source_->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->stamp, at(seconds));
    EXPECT_EQ(frame->color(0, 0).g, 2);
    EXPECT_EQ(frame->depth(7, 5), 2.0F);
  }
}

TEST_F(Ros2SourceTest, FramesHaveMotionUpToTheirEnd) {
  start({.color = "color",
         .depth = "depth",
         .camera_info = "camera_info",
         .imu = "imu",
         .wheels = "wheels"},
        {&color_, &depth_, &camera_info_, &imu_, &wheels_});
  msg::TransformStamped mounting{{0, at(0.0), "camera"}, "imu_link", {}};
  mounting.transform.position = {0.1, 0.2, 0.3};
  msg::TransformStamped base{{0, at(0.0), "camera"}, "base", {}};
  base.transform.position = {0.0, 0.5, 0.0};
  tf_static_.publish(msg::Transforms{{mounting, base}});
  publish_images(0.0);
  for (int i = 0; i < 10; ++i) {
    publish_imu(0.01 * i);
    msg::Odometry odometry;
    odometry.header = header_at(0.01 * i, "odom");
    odometry.child_frame_id = "base";
    odometry.pose.position[0] = i;
    wheels_.publish(odometry);
  }
  ASSERT_TRUE(source_->wait(ignore));
  const MotionCalibration& motion = source_->calibration()->motion;
  ASSERT_TRUE(motion.T_sensor_imu && motion.T_sensor_base);
  EXPECT_NEAR(motion.T_sensor_imu->translation().z(), 0.3, 1e-12);
  EXPECT_NEAR(motion.T_sensor_base->translation().y(), 0.5, 1e-12);
  const auto first = source_->next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->motion.imu.size(), 3U);  // up to 20 ms after the frame
  EXPECT_EQ(first->motion.wheels.size(), 3U);
  publish_images(0.05);
  const auto second = source_->next();
  ASSERT_TRUE(second);
  ASSERT_EQ(second->motion.imu.size(), 5U);
  EXPECT_NEAR(second->motion.imu.front().rate.x(), 0.03, 1e-12);
  EXPECT_EQ(second->motion.wheels.back().T_odom_base.translation().x(), 7.0);
  EXPECT_EQ(second->calibration, first->calibration);
}

TEST_F(Ros2SourceTest, InitialPoseOfTheMapIsTheExpectedPlaceOfTheNextFrame) {
  start({.color = "color",
         .depth = "depth",
         .camera_info = "camera_info",
         .initial_pose = "initialpose",
         .map_frame = "map"},
        {&color_, &depth_, &camera_info_, &initial_pose_});
  // 3 m ahead and 1 m to the left of the map's first camera, turned to the left.
  msg::PoseWithCovarianceStamped told;
  told.header = header_at(0.0, "map");
  told.pose.position = {3.0, 1.0, 0.0};
  told.pose.orientation = {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)};
  initial_pose_.publish(told);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  for (const double seconds : {0.0, 0.1}) publish_images(seconds);
  ASSERT_TRUE(source_->wait(ignore));
  const auto first = source_->next();
  ASSERT_TRUE(first && first->expected_place);
  EXPECT_TRUE(first->expected_place->translation().isApprox(Eigen::Vector3d(-1.0, 0.0, 3.0)));
  EXPECT_TRUE(first->expected_place->rotation().isApprox(
      Eigen::AngleAxisd(-std::numbers::pi / 2.0, Eigen::Vector3d::UnitY()).matrix()));
  EXPECT_FALSE(source_->next()->expected_place);
}

TEST_F(Ros2SourceTest, InitialPoseOfAnotherFrameIsRefused) {
  start({.color = "color",
         .depth = "depth",
         .camera_info = "camera_info",
         .initial_pose = "initialpose"},
        {&color_, &depth_, &camera_info_, &initial_pose_});
  msg::PoseWithCovarianceStamped told;
  told.header = header_at(0.0, "odom");
  initial_pose_.publish(told);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  publish_images(0.0);
  ASSERT_TRUE(source_->wait(ignore));
  EXPECT_FALSE(source_->next()->expected_place);
  EXPECT_EQ(source_->counts().damaged, 1U);
}

TEST_F(Ros2SourceTest, FramesGoOnWithoutMotionThatDoesNotCome) {
  start({.color = "color", .depth = "depth", .camera_info = "camera_info", .imu = "imu"},
        {&color_, &depth_, &camera_info_, &imu_});
  publish_images(0.0);
  ASSERT_TRUE(source_->wait(ignore));
  const auto frame = source_->next();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->motion.empty());
  node_->stop();
  EXPECT_EQ(source_->counts().incomplete, 1U);
}

TEST_F(Ros2SourceTest, MasksAreThoseOfTheSameStamp) {
  start({.color = "color", .depth = "depth", .camera_info = "camera_info", .mask = "mask"},
        {&color_, &depth_, &camera_info_, &mask_});
  publish_images(0.0);
  publish_images(0.1);
  // Of the first frame there is none.
  mask_.publish(image_message(header_at(0.1, "camera"), Image<std::uint8_t>(kWidth, kHeight, 1)));
  ASSERT_TRUE(source_->wait(ignore));
  const auto first = source_->next();
  const auto second = source_->next();
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(first->mask.empty());
  ASSERT_FALSE(second->mask.empty());
  EXPECT_EQ(second->mask(0, 0), 1);
}

TEST_F(Ros2SourceTest, SkipsFramesOfAnEarlierTimeAndDamagedMessages) {
  start({.color = "color", .depth = "depth", .camera_info = "camera_info"},
        {&color_, &depth_, &camera_info_});
  publish_images(1.0);
  ASSERT_TRUE(source_->wait(ignore));
  publish_images(0.0);  // as from a bag that starts again
  msg::Image damaged = image_message(header_at(1.5, "camera"), Image<float>(kWidth, kHeight, 2.0F));
  damaged.data.resize(3);
  depth_.publish(damaged);
  publish_images(2.0);
  EXPECT_EQ(source_->next()->stamp, at(1.0));
  EXPECT_EQ(source_->next()->stamp, at(2.0));
  node_->stop();
  EXPECT_EQ(source_->counts().not_later, 1U);
  EXPECT_EQ(source_->counts().damaged, 1U);
  EXPECT_EQ(source_->counts().frames, 2U);
}

TEST_F(Ros2SourceTest, ScansWithImagesWaitForTransform) {
  start({.color = "color", .camera_info = "camera_info", .points = "points"},
        {&color_, &camera_info_, &points_});
  publish_images(0.0);
  LidarScan scan;
  scan.points = {Eigen::Vector3f(1.0F, 2.0F, 3.0F)};
  points_.publish(cloud_message(header_at(0.01, "lidar"), scan));
  publish_images(0.1);
  msg::TransformStamped mounting{{0, at(0.0), "camera"}, "lidar", {}};
  mounting.transform.position = {0.0, -0.1, 0.0};
  tf_static_.publish(msg::Transforms{{mounting}});
  ASSERT_TRUE(source_->wait(ignore));
  EXPECT_NEAR(source_->calibration()->T_camera_lidar.translation().y(), -0.1, 1e-12);
  const auto frame = source_->next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->scan.points.size(), 1U);
  EXPECT_FALSE(frame->color.empty());
  EXPECT_EQ(source_->sensor_frame(), "lidar");
}

TEST_F(Ros2SourceTest, MasksOfScansAreThoseOfTheirImage) {
  start({.color = "color", .camera_info = "camera_info", .points = "points", .mask = "mask"},
        {&color_, &camera_info_, &points_, &mask_});
  const msg::TransformStamped mounting{{0, at(0.0), "camera"}, "lidar", {}};
  tf_static_.publish(msg::Transforms{{mounting}});
  LidarScan scan;
  scan.points = {Eigen::Vector3f(1.0F, 2.0F, 3.0F)};
  publish_images(0.03);
  points_.publish(cloud_message(header_at(0.01, "lidar"), scan));
  publish_images(0.13);
  points_.publish(cloud_message(header_at(0.14, "lidar"), scan));
  publish_images(0.23);
  const auto publish_mask = [&](double seconds, std::uint8_t label) {
    mask_.publish(
        image_message(header_at(seconds, "camera"), Image<std::uint8_t>(kWidth, kHeight, label)));
  };
  publish_mask(0.03, 1);
  publish_mask(0.13, 2);
  ASSERT_TRUE(source_->wait(ignore));
  for (const std::uint8_t label : {std::uint8_t{1}, std::uint8_t{2}}) {
    const auto frame = source_->next();
    ASSERT_TRUE(frame);
    ASSERT_FALSE(frame->mask.empty());
    EXPECT_EQ(frame->mask(0, 0), label);
  }
}

/// Of a camera of half the size, 5 cm beside the color camera.
TEST_F(Ros2SourceTest, RegistersDepthOfAnotherFrame) {
  start({.color = "color",
         .depth = "depth",
         .depth_info = "depth_info",
         .camera_info = "camera_info"},
        {&color_, &depth_, &camera_info_, &depth_info_});
  DepthCamera depth_camera;
  depth_camera.camera = camera();
  depth_camera.camera.width = kWidth / 2;
  depth_camera.camera.height = kHeight / 2;
  depth_camera.camera.fx = depth_camera.camera.fy = 4.0;
  depth_camera.camera.cx = 1.5;
  depth_camera.camera.cy = 1.0;
  Image<float> depth(kWidth / 2, kHeight / 2, 2.0F);
  depth(1, 1) = 1.0F;
  const auto publish = [&](double seconds) {
    camera_info_.publish(camera_info_message(header_at(seconds, "camera"), camera()));
    color_.publish(
        image_message(header_at(seconds, "camera"), Image<Rgb>(kWidth, kHeight, Rgb{1, 2, 3})));
    depth_.publish(image_message(header_at(seconds, "depth_camera"), depth));
  };
  publish(0.0);
  EXPECT_TRUE(reports("camera_info of the depth images: none on depth_info"));
  depth_info_.publish(camera_info_message(header_at(0.0, "depth_camera"), depth_camera.camera));
  EXPECT_TRUE(reports("no transform from 'depth_camera' to 'camera'"));
  msg::TransformStamped mounting{{0, at(0.0), "camera"}, "depth_camera", {}};
  mounting.transform.position = {-0.05, 0.0, 0.0};
  tf_static_.publish(msg::Transforms{{mounting}});
  ASSERT_TRUE(source_->wait(ignore));
  EXPECT_FALSE(source_->calibration()->depth_camera);
  publish(0.1);
  depth_camera.T_color_depth =
      Transform<Camera, Depth>(Eigen::Isometry3d(Eigen::Translation3d(-0.05, 0.0, 0.0)));
  const Image<float> expected = DepthRegistration(depth_camera, camera()).apply(depth);
  for (int i = 0; i < 2; ++i) {
    const auto frame = source_->next();
    ASSERT_TRUE(frame);
    EXPECT_TRUE(std::ranges::equal(frame->depth.pixels(), expected.pixels()));
  }
}

TEST_F(Ros2SourceTest, TakesDepthOfTheColorFrameAsRegistered) {
  start({.color = "color",
         .depth = "depth",
         .depth_info = "depth_info",
         .camera_info = "camera_info"},
        {&color_, &depth_, &camera_info_});
  publish_images(0.0);
  ASSERT_TRUE(source_->wait(ignore));
  EXPECT_EQ(source_->next()->depth(7, 5), 2.0F);
}

TEST_F(Ros2SourceTest, DecodesCompressedImages) {
  start(
      {.color = "color/compressed", .depth = "depth/compressedDepth", .camera_info = "camera_info"},
      {&compressed_color_, &compressed_depth_, &camera_info_});
  camera_info_.publish(camera_info_message(header_at(0.0, "camera"), camera()));
  compressed_color_.publish(compressed_message(
      header_at(0.0, "camera"), Image<Rgb>(kWidth, kHeight, Rgb{100, 150, 200}), 95));
  compressed_depth_.publish(compressed_message(
      header_at(0.0, "camera"), Image<std::uint16_t>(kWidth, kHeight, std::uint16_t{1500})));
  ASSERT_TRUE(source_->wait(ignore));
  const auto frame = source_->next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->depth(7, 5), 1.5F);
  EXPECT_NEAR(frame->color(0, 0).g, 150, 3);
}

TEST_F(Ros2SourceTest, EndsWhenAsked) {
  start({.color = "color", .depth = "depth", .camera_info = "camera_info"}, {&color_});
  stop_ = true;
  EXPECT_FALSE(source_->wait(ignore));
}

TEST_F(Ros2SourceTest, MountingOfAGyroscopeThatStartsLaterIsFound) {
  start({.color = "color", .depth = "depth", .camera_info = "camera_info", .imu = "imu"},
        {&color_, &depth_, &camera_info_, &imu_});
  tf_static_.publish(msg::Transforms{{{{0, at(0.0), "camera"}, "imu_link", {}}}});
  publish_images(0.0);
  std::string said;
  ASSERT_TRUE(source_->wait([&](const std::string& message) { said += message; }));  // after 2 s
  EXPECT_NE(said.find("no messages on imu"), std::string::npos);
  ASSERT_TRUE(source_->next());
  for (int i = 0; i < 20; ++i) publish_imu(0.01 * i);
  publish_images(0.1);
  const auto frame = source_->next();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->calibration->motion.T_sensor_imu);
}

TEST_F(Ros2SourceTest, ReportsImagesWithoutFrame) {
  start({.color = "color",
         .depth = "depth",
         .depth_info = "depth_info",
         .camera_info = "camera_info"},
        {&color_, &depth_, &camera_info_});
  color_.publish(image_message(header_at(0.0, ""), Image<Rgb>(kWidth, kHeight, Rgb{1, 2, 3})));
  depth_.publish(image_message(header_at(0.0, ""), Image<float>(kWidth, kHeight, 2.0F)));
  EXPECT_TRUE(reports("give --depth-registered"));
}

}  // namespace
}  // namespace mms
