#include <cmath>

#include "mms/core/error.hpp"
#include "mms/dataset/recorder/frame_recorder.hpp"
#include "mms/dataset/recorder/recorded_frame.hpp"
#include "mms/ros/bag/bag_files.hpp"
#include "mms/ros/camera_messages.hpp"
#include "mms/ros/cloud_messages.hpp"
#include "mms/ros/image_messages.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {
namespace {

constexpr const char* kCameraFrame = "camera_color_optical_frame";
constexpr const char* kLidarFrame = "lidar";
constexpr const char* kBaseFrame = "base_link";
constexpr const char* kImuFrame = "imu_link";
constexpr const char* kColorTopic = "/camera/color/image_raw";
constexpr const char* kInfoTopic = "/camera/color/camera_info";
constexpr const char* kDepthTopic = "/camera/aligned_depth_to_color/image_raw";
constexpr const char* kMaskTopic = "/camera/mask/image_raw";
constexpr const char* kCloudTopic = "/points";
constexpr const char* kWheelTopic = "/wheel/odometry";
constexpr const char* kImuTopic = "/imu";
constexpr const char* kTruthTopic = "/ground_truth";
constexpr double kMillimetres = 1000.0;  // units per meter
constexpr int kJpegQuality = 95;

class BagRecorder final : public FrameRecorder {
 public:
  BagRecorder(const std::filesystem::path& path, bool compressed)
      : bag_(create_bag(path)), compressed_(compressed) {}

  void add(const Frame& frame) override {
    if (count_ == 0) {
      add_extrinsics(frame);
      add_mounting(frame);
    }
    add_motion(frame);
    const msg::Header header = header_of(frame.stamp, kCameraFrame);
    if (!frame.color.empty()) add_color(frame, header);
    if (frame.has_depth()) add_depth(frame);
    if (!frame.mask.empty()) {
      bag_->write(kMaskTopic, frame.stamp, image_message(header, frame.mask));
    }
    if (!frame.scan.points.empty()) {
      bag_->write(kCloudTopic, frame.stamp,
                  cloud_message(header_of(frame.stamp, kLidarFrame), frame.scan));
    }
    ++count_;
  }

  void finish(const Trajectory& truth) override {
    for (const StampedPose& pose : truth) {
      bag_->write(kTruthTopic, pose.stamp,
                  msg::PoseStamped{header_of(pose.stamp, "world"),
                                   pose_message(pose.T_world_sensor.isometry())});
    }
    bag_->finish();
  }

 private:
  msg::Header header_of(Timestamp stamp, const char* frame_id) const {
    return {count_, stamp, frame_id};
  }

  void add_extrinsics(const Frame& frame) {
    if (frame.scan.points.empty() || frame.color.empty()) return;
    add_transform(frame.stamp, kCameraFrame, kLidarFrame,
                  frame.calibration->T_camera_lidar.isometry());
  }

  void add_transform(Timestamp stamp, const char* parent, const char* child,
                     const Eigen::Isometry3d& T_parent_child) {
    msg::TransformStamped transform;
    transform.header = header_of(stamp, parent);
    transform.child_frame_id = child;
    transform.transform = pose_message(T_parent_child);
    bag_->write("/tf_static", stamp, msg::Transforms{{transform}});
  }

  void add_mounting(const Frame& frame) {
    const MotionCalibration& motion = frame.calibration->motion;
    const char* sensor = frame.scan.points.empty() ? kCameraFrame : kLidarFrame;
    if (motion.T_sensor_base) {
      add_transform(frame.stamp, sensor, kBaseFrame, motion.T_sensor_base->isometry());
    }
    if (motion.T_sensor_imu) {
      add_transform(frame.stamp, sensor, kImuFrame, motion.T_sensor_imu->isometry());
    }
  }

  /// Stamps are on the clock of the frames: bags have no place for delays.
  void add_motion(const Frame& frame) {
    const MotionCalibration& motion = frame.calibration->motion;
    for (const WheelSample& sample : frame.motion.wheels) {
      const Timestamp stamp = sample.stamp - motion.wheel_delay;
      if (stamp < Timestamp()) continue;
      msg::Odometry message;
      message.header = header_of(stamp, "odom");
      message.child_frame_id = kBaseFrame;
      message.pose = pose_message(sample.T_odom_base.isometry());
      bag_->write(kWheelTopic, stamp, message);
    }
    for (const ImuSample& sample : frame.motion.imu) {
      const Timestamp stamp = sample.stamp - motion.imu_delay;
      if (stamp < Timestamp()) continue;
      msg::Imu message;
      message.header = header_of(stamp, kImuFrame);
      message.angular_velocity = {sample.rate.x(), sample.rate.y(), sample.rate.z()};
      message.linear_acceleration = {sample.acceleration.x(), sample.acceleration.y(),
                                     sample.acceleration.z()};
      bag_->write(kImuTopic, stamp, message);
    }
  }

  void add_color(const Frame& frame, const msg::Header& header) {
    if (frame.calibration->camera) {
      bag_->write(kInfoTopic, frame.stamp, camera_info_message(header, *frame.calibration->camera));
    }
    if (compressed_) {
      bag_->write(std::string(kColorTopic) + "/compressed", frame.stamp,
                  compressed_message(header, frame.color, kJpegQuality));
    } else {
      bag_->write(kColorTopic, frame.stamp, image_message(header, frame.color));
    }
  }

  void add_depth(const Frame& frame) {
    const Timestamp stamp = frame.stamp + frame.depth_offset;
    const msg::Header header = header_of(stamp, kCameraFrame);
    const bool in_millimetres = frame.calibration->depth_scale == kMillimetres;
    if (compressed_) {
      bag_->write(std::string(kDepthTopic) + "/compressedDepth", stamp,
                  compressed_message(header, recorded_depth(frame.depth, kMillimetres)));
    } else if (in_millimetres) {
      bag_->write(kDepthTopic, stamp,
                  image_message(header, recorded_depth(frame.depth, kMillimetres)));
    } else {
      bag_->write(kDepthTopic, stamp, image_message(header, frame.depth));
    }
  }

  std::unique_ptr<BagWriter> bag_;
  bool compressed_;
  std::uint32_t count_ = 0;
};

}  // namespace

std::unique_ptr<FrameRecorder> record_bag(const std::filesystem::path& path, bool compressed) {
  return std::make_unique<BagRecorder>(path, compressed);
}

}  // namespace mms
