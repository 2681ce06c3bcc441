#include "mms/dataset/bag/bag_topics.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

/// Topics of a bag, with the encodings of their images.
struct Topics {
  Topics& add(const std::string& name, const std::string& type, const std::string& encoding = "",
              std::size_t count = 10) {
    list.push_back({name, type, count});
    encodings.push_back(encoding);
    return *this;
  }
  Topics& image(const std::string& name, const std::string& encoding) {
    return add(name, "sensor_msgs/Image", encoding);
  }
  Topics& camera_info(const std::string& name) { return add(name, "sensor_msgs/CameraInfo"); }

  BagTopicNames choose(const BagTopicNames& given = {}) const {
    const auto encoding_of = [this](const BagTopic& topic) {
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (list[i].name == topic.name) return encodings[i];
      }
      return std::string();
    };
    return choose_topics(list, given, encoding_of, "x.bag");
  }
  std::string error(const BagTopicNames& given = {}) const {
    return message_of<DataError>([&] { choose(given); });
  }

  std::vector<BagTopic> list;
  std::vector<std::string> encodings;
};

TEST(BagTopics, ChoosesTopicsOfRealSense) {
  const BagTopicNames chosen = Topics()
                                   .image("/camera/infra1/image_rect_raw", "mono8")
                                   .image("/camera/depth/image_rect_raw", "16UC1")
                                   .camera_info("/camera/aligned_depth_to_color/camera_info")
                                   .image("/camera/aligned_depth_to_color/image_raw", "16UC1")
                                   .camera_info("/camera/color/camera_info")
                                   .image("/camera/color/image_raw", "rgb8")
                                   .add("/camera/depth/color/points", "sensor_msgs/PointCloud2")
                                   .choose();
  EXPECT_EQ(chosen.color, "/camera/color/image_raw");
  EXPECT_EQ(chosen.depth, "/camera/aligned_depth_to_color/image_raw");
  EXPECT_EQ(chosen.camera_info, "/camera/color/camera_info");
  EXPECT_EQ(chosen.cloud, "");
}

TEST(BagTopics, ChoosesTopicsOfTumBenchmark) {
  const BagTopicNames chosen = Topics()
                                   .camera_info("/camera/depth/camera_info")
                                   .image("/camera/depth/image", "32FC1")
                                   .camera_info("/camera/rgb/camera_info")
                                   .image("/camera/rgb/image_color", "rgb8")
                                   .add("/tf", "tf/tfMessage")
                                   .add("/cortex_marker_array", "visualization_msgs/MarkerArray")
                                   .choose();
  EXPECT_EQ(chosen.color, "/camera/rgb/image_color");
  EXPECT_EQ(chosen.depth, "/camera/depth/image");
  EXPECT_EQ(chosen.camera_info, "/camera/rgb/camera_info");
  EXPECT_EQ(chosen.truth, "");
}

TEST(BagTopics, ChoosesCompressedImages) {
  const BagTopicNames chosen =
      Topics()
          .add("/cam/depth_registered/image_raw/compressedDepth", "sensor_msgs/CompressedImage")
          .add("/cam/rgb/image_raw/compressed", "sensor_msgs/CompressedImage")
          .camera_info("/cam/depth_registered/camera_info")
          .camera_info("/cam/rgb/image_raw/camera_info")
          .camera_info("/cam/rgb/camera_info")
          .choose();
  EXPECT_EQ(chosen.color, "/cam/rgb/image_raw/compressed");
  EXPECT_EQ(chosen.depth, "/cam/depth_registered/image_raw/compressedDepth");
}

/// image_transport offers depth as JPEG, too, which is none.
TEST(BagTopics, PrefersTransportOfDepth) {
  const Topics topics =
      Topics()
          .add("/cam/color/image_raw/compressed", "sensor_msgs/CompressedImage", "jpeg")
          .add("/cam/depth/image_raw/compressed", "sensor_msgs/CompressedImage", "16UC1; png")
          .add("/cam/depth/image_raw/compressedDepth", "sensor_msgs/CompressedImage")
          .add("/cam/aligned_depth/image/compressed", "sensor_msgs/CompressedImage", "16UC1; jpeg");
  EXPECT_EQ(topics.choose().depth, "/cam/depth/image_raw/compressedDepth");
  EXPECT_EQ(topics.choose().color, "/cam/color/image_raw/compressed");
}

TEST(BagTopics, ChoosesLidarWithCameraAndGroundTruth) {
  const BagTopicNames chosen = Topics()
                                   .add("/odom", "nav_msgs/Odometry")
                                   .add("/vicon/robot/pose", "geometry_msgs/PoseStamped")
                                   .image("/left/image_mono", "mono8")
                                   .add("/os_cloud_node/points", "sensor_msgs/PointCloud2", "", 100)
                                   .add("/obstacles", "sensor_msgs/PointCloud2", "", 30)
                                   .choose();
  EXPECT_EQ(chosen.cloud, "/os_cloud_node/points");
  EXPECT_EQ(chosen.color, "/left/image_mono");
  EXPECT_EQ(chosen.truth, "/vicon/robot/pose");
  EXPECT_EQ(chosen.depth, "");
  EXPECT_EQ(chosen.camera_info, "");
  EXPECT_EQ(chosen.wheels, "/odom");
  EXPECT_EQ(chosen.imu, "");
}

TEST(BagTopics, ChoosesWheelsAndGyroscopeButNoOtherOdometry) {
  const Topics topics = Topics()
                            .add("/points", "sensor_msgs/PointCloud2")
                            .add("/a/visual_odom", "nav_msgs/Odometry")
                            .add("/odometry/filtered", "nav_msgs/Odometry")
                            .add("/odom", "nav_msgs/Odometry")
                            .add("/wheel_odometry", "nav_msgs/Odometry")
                            .add("/camera/accel/sample", "sensor_msgs/Imu")
                            .add("/camera/gyro/sample", "sensor_msgs/Imu");
  EXPECT_EQ(topics.choose().wheels, "/wheel_odometry");
  EXPECT_EQ(topics.choose().imu, "/camera/gyro/sample");
  EXPECT_EQ(topics.choose({.wheels = "/odom"}).wheels, "/odom");
}

/// As recorded with all topics while another program runs.
TEST(BagTopics, PrefersSensorsToResultsOfPrograms) {
  Topics topics = Topics()
                      .add("/Odometry", "nav_msgs/Odometry")
                      .add("/mavros/local_position/odom", "nav_msgs/Odometry")
                      .add("/kiss/odometry", "nav_msgs/Odometry")
                      .add("/cloud_registered", "sensor_msgs/PointCloud2", "", 20)
                      .add("/camera/depth/points", "sensor_msgs/PointCloud2", "", 30);
  EXPECT_EQ(topics.choose().wheels, "");
  EXPECT_EQ(topics.choose().cloud, "/camera/depth/points");  // where there is no other
  topics.add("/velodyne_points", "sensor_msgs/PointCloud2", "", 10);
  EXPECT_EQ(topics.choose().cloud, "/velodyne_points");
  EXPECT_EQ(topics.choose({.cloud = "/cloud_registered"}).cloud, "/cloud_registered");
  EXPECT_EQ(topics.choose({.wheels = "/Odometry"}).wheels, "/Odometry");
}

TEST(BagTopics, ChoosesScansOfLivox) {
  Topics topics = Topics()
                      .add("/cloud_registered", "sensor_msgs/PointCloud2", "", 20)
                      .add("/livox/lidar", "livox_ros_driver/CustomMsg");
  EXPECT_EQ(topics.choose().cloud, "/livox/lidar");
  topics.add("/os_cloud_node/points", "sensor_msgs/PointCloud2");
  EXPECT_EQ(topics.choose().cloud, "/os_cloud_node/points");
  EXPECT_EQ(topics.choose({.cloud = "/livox/lidar"}).cloud, "/livox/lidar");
}

TEST(BagTopics, ChoosesGyroscopeOfTheDevice) {
  Topics topics = Topics()
                      .add("/camera/imu", "sensor_msgs/Imu")
                      .add("/os_cloud_node/imu", "sensor_msgs/Imu")
                      .add("/os_cloud_node/points", "sensor_msgs/PointCloud2");
  EXPECT_EQ(topics.choose().imu, "/os_cloud_node/imu");
  topics.image("/camera/color/image_raw", "rgb8").image("/camera/depth/image_raw", "16UC1");
  EXPECT_EQ(topics.choose().imu, "/camera/imu");
}

TEST(BagTopics, TakesRawColorsWhereThereAreNoOthers) {
  Topics topics = Topics()
                      .image("/camera/color/image_raw", "yuv422_yuy2")
                      .image("/camera/depth/image_raw", "16UC1")
                      .add("/camera/points", "sensor_msgs/PointCloud2");
  EXPECT_EQ(topics.choose().color, "/camera/color/image_raw");
  EXPECT_EQ(topics.choose().depth, "/camera/depth/image_raw");
  EXPECT_EQ(topics.choose().cloud, "");
  EXPECT_EQ(topics.image("/other", "mono8").choose().color, "/other");
  const Topics lidar =
      Topics().image("/camera/image_raw", "bayer_rggb8").add("/points", "sensor_msgs/PointCloud2");
  EXPECT_EQ(lidar.choose().color, "");
  EXPECT_EQ(lidar.choose({.color = "/camera/image_raw"}).color, "/camera/image_raw");
}

TEST(BagTopics, NamesColorInEncodingsThatAreNotRead) {
  Topics topics =
      Topics().image("/camera/color/image_raw", "nv12").image("/camera/depth/image_raw", "16UC1");
  expect_in("nor point clouds; encodings that are not read: /camera/color/image_raw is 'nv12'",
            topics.error());
  topics.add("/camera/points", "sensor_msgs/PointCloud2");
  expect_in(
      "has depth in /camera/depth/image_raw, but color in an encoding that is not read: "
      "/camera/color/image_raw is 'nv12'",
      topics.error());
  expect_in("or choose the clouds with --topic-cloud /camera/points", topics.error());
  EXPECT_EQ(topics.choose({.cloud = "/camera/points"}).cloud, "/camera/points");
}

TEST(BagTopics, DoesNotUseMasksAsColor) {
  const BagTopicNames chosen =
      Topics().image("/mask", "mono8").image("/image", "mono8").image("/depth", "16UC1").choose();
  EXPECT_EQ(chosen.color, "/image");
  EXPECT_EQ(chosen.mask, "/mask");
}

TEST(BagTopics, GivenTopicsHavePriority) {
  const Topics topics = Topics()
                            .image("/a/rgb", "rgb8")
                            .image("/b/grey", "mono8")
                            .image("/a/depth", "16UC1")
                            .image("/b/range", "32FC1")
                            .add("/odom", "nav_msgs/Odometry")
                            .add("/points", "sensor_msgs/PointCloud2");
  const BagTopicNames chosen =
      topics.choose({.color = "/b/grey", .depth = "/b/range", .truth = "/odom"});
  EXPECT_EQ(chosen.color, "/b/grey");
  EXPECT_EQ(chosen.depth, "/b/range");
  EXPECT_EQ(chosen.truth, "/odom");
  EXPECT_EQ(topics.choose({.cloud = "/points"}).depth, "");
}

TEST(BagTopics, AsksForOneOfTwoCameras) {
  Topics topics;
  for (const std::string camera : {"/front", "/rear"}) {
    topics.image(camera + "/aligned_depth_to_color/image_raw", "16UC1")
        .image(camera + "/color/image_raw", "rgb8")
        .camera_info(camera + "/color/camera_info");
  }
  expect_in("has several depth cameras, of /front/color/image_raw and /rear/color/image_raw",
            topics.error());
  expect_in("(choose one with --topic-color /front/color/image_raw)", topics.error());
  const BagTopicNames rear = topics.choose({.color = "/rear/color/image_raw"});
  EXPECT_EQ(rear.depth, "/rear/aligned_depth_to_color/image_raw");
  EXPECT_EQ(rear.camera_info, "/rear/color/camera_info");
  const std::string depth = "/rear/aligned_depth_to_color/image_raw";
  EXPECT_EQ(topics.choose({.depth = depth}).color, "/rear/color/image_raw");
}

TEST(BagTopics, ChoosesAmongImagesOfOneCamera) {
  const BagTopicNames chosen = Topics()  // of an Azure Kinect
                                   .image("/depth/image_raw", "16UC1")
                                   .image("/depth_to_rgb/image_raw", "16UC1")
                                   .image("/rgb/image_raw", "bgra8")
                                   .image("/rgb_to_depth/image_raw", "bgra8")
                                   .choose();
  EXPECT_EQ(chosen.color, "/rgb/image_raw");
  EXPECT_EQ(chosen.depth, "/depth_to_rgb/image_raw");
}

TEST(BagTopics, ErrorsListTopics) {
  const Topics topics = Topics().image("/rgb", "rgb8").add("/scan", "sensor_msgs/LaserScan");
  const std::string missing = topics.error();
  expect_in("x.bag: has neither color images with depth nor point clouds", missing);
  expect_in("it has /rgb sensor_msgs/Image (10), /scan sensor_msgs/LaserScan (10)", missing);
  expect_in("--topic-depth is /none, which is missing; it has /rgb",
            topics.error({.depth = "/none"}));
  expect_in(
      "--topic-depth is /scan, which has type sensor_msgs/LaserScan, expected sensor_msgs/Image or",
      topics.error({.depth = "/scan"}));
  expect_in("it has no topics", Topics().error());
  expect_in("/depth, which has no messages",
            Topics().add("/depth", "sensor_msgs/Image", "16UC1", 0).error({.depth = "/depth"}));
}

TEST(BagTopics, TakesNoPicturesOfMasks) {
  Topics topics;  // of a simulator
  topics.image("/depth/image", "32FC1")
      .image("/rgb/image", "bgra8")
      .image("/segmentation/colored_map", "rgb8");
  EXPECT_EQ(topics.choose().color, "/rgb/image");
  EXPECT_EQ(topics.choose().mask, "");
  topics.image("/segmentation/labels_map", "mono8");
  EXPECT_EQ(topics.choose().mask, "/segmentation/labels_map");
}

}  // namespace
}  // namespace mms
