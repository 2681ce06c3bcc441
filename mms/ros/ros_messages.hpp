#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mms/core/time.hpp"

namespace mms::msg {

// Sensor messages of ROS 1 and ROS 2 as plain structs (serialization: wire.hpp). Fields have the
// names, order and meaning of ROS 1; those of ROS 2 differ in case only.

/// std_msgs/Header
struct Header {
  std::uint32_t seq = 0;  ///< of ROS 1 alone
  Timestamp stamp;
  std::string frame_id;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    if (archive.is_ros1()) archive(self.seq);
    archive(self.stamp, self.frame_id);
  }
};

/// std_msgs/Float32
struct Float32 {
  float data = 0.0F;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.data);
  }
};

/// sensor_msgs/Image
struct Image {
  Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string encoding;
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;
  std::vector<std::uint8_t> data;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.height, self.width, self.encoding, self.is_bigendian, self.step,
            self.data);
  }
};

/// sensor_msgs/CompressedImage
struct CompressedImage {
  Header header;
  std::string format;
  std::vector<std::uint8_t> data;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.format, self.data);
  }
};

/// sensor_msgs/CameraInfo with its sensor_msgs/RegionOfInterest
struct CameraInfo {
  Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string distortion_model;
  std::vector<double> D;
  std::array<double, 9> K{};
  std::array<double, 9> R{};
  std::array<double, 12> P{};
  std::uint32_t binning_x = 0;
  std::uint32_t binning_y = 0;
  std::array<std::uint32_t, 4> roi{};  ///< x_offset, y_offset, height, width
  bool do_rectify = false;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.height, self.width, self.distortion_model, self.D, self.K, self.R,
            self.P, self.binning_x, self.binning_y, self.roi, self.do_rectify);
  }
};

/// sensor_msgs/PointField
struct PointField {
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;
  std::uint32_t count = 1;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.name, self.offset, self.datatype, self.count);
  }
};

/// sensor_msgs/PointCloud2
struct PointCloud2 {
  Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::vector<PointField> point_fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = false;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.height, self.width, self.point_fields, self.is_bigendian,
            self.point_step, self.row_step, self.data, self.is_dense);
  }
};

/// livox_ros_driver/CustomPoint
struct LivoxPoint {
  std::uint32_t offset_time = 0;    ///< after the timebase [ns]
  std::array<float, 3> position{};  ///< x y z [m]; zeros without return
  std::uint8_t reflectivity = 0;
  std::uint8_t tag = 0;   ///< kind of return
  std::uint8_t line = 0;  ///< number of the laser

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.offset_time, self.position, self.reflectivity, self.tag, self.line);
  }
};

/// livox_ros_driver/CustomMsg, and the same of livox_ros_driver2 and livox_interfaces
struct LivoxScan {
  Header header;               ///< its stamp is the timebase on the clock of ROS
  std::uint64_t timebase = 0;  ///< of the first point, by the clock of the sensor [ns]
  std::uint32_t point_num = 0;
  std::uint8_t lidar_id = 0;
  std::array<std::uint8_t, 3> rsvd{};
  std::vector<LivoxPoint> points;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.timebase, self.point_num, self.lidar_id, self.rsvd, self.points);
  }
};

/// geometry_msgs/Pose, and geometry_msgs/Transform, which has the same fields.
struct Pose {
  std::array<double, 3> position{};                       ///< x y z [m]
  std::array<double, 4> orientation{0.0, 0.0, 0.0, 1.0};  ///< x y z w

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.position, self.orientation);
  }
};

/// geometry_msgs/PoseStamped
struct PoseStamped {
  Header header;
  Pose pose;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.pose);
  }
};

/// geometry_msgs/TransformStamped
struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Pose transform;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.child_frame_id, self.transform);
  }
};

/// tf2_msgs/TFMessage, and tf/tfMessage, which has the same fields
struct Transforms {
  std::vector<TransformStamped> transforms;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.transforms);
  }
};

/// nav_msgs/Odometry
struct Odometry {
  Header header;
  std::string child_frame_id;
  Pose pose;
  std::array<double, 36> pose_covariance{};
  std::array<double, 6> twist{};  ///< linear, angular; in the child's frame
  std::array<double, 36> twist_covariance{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.child_frame_id, self.pose, self.pose_covariance, self.twist,
            self.twist_covariance);
  }
};

/// geometry_msgs/PoseWithCovarianceStamped
struct PoseWithCovarianceStamped {
  Header header;
  Pose pose;
  std::array<double, 36> covariance{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.pose, self.covariance);
  }
};

/// sensor_msgs/Imu
struct Imu {
  Header header;
  std::array<double, 4> orientation{0.0, 0.0, 0.0, 1.0};  ///< x y z w
  std::array<double, 9> orientation_covariance{};
  std::array<double, 3> angular_velocity{};  ///< [rad/s]
  std::array<double, 9> angular_velocity_covariance{};
  std::array<double, 3> linear_acceleration{};  ///< [m/s^2]
  std::array<double, 9> linear_acceleration_covariance{};

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.header, self.orientation, self.orientation_covariance, self.angular_velocity,
            self.angular_velocity_covariance, self.linear_acceleration,
            self.linear_acceleration_covariance);
  }
};

}  // namespace mms::msg
