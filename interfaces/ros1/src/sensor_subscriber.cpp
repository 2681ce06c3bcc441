#include "interfaces/ros1/src/sensor_subscriber.hpp"

#include "interfaces/ros1/src/ros_traits.hpp"
#include "mms/core/error.hpp"
#include "mms/ros/camera_messages.hpp"
#include "mms/ros/cloud_messages.hpp"
#include "mms/ros/image_messages.hpp"

namespace mms {
namespace {

constexpr std::uint32_t kQueue = 30;
constexpr double kRepeat = 5.0;  // between warnings [s]

template <class Message, class Callback>
ros::Subscriber subscribe_to(ros::NodeHandle& node, const std::string& topic,
                             const Callback& callback) {
  using Pointer = boost::shared_ptr<const Message>;
  return node.subscribe<Message>(topic, kQueue,
                                 boost::function<void(const Pointer&)>(
                                     [callback](const Pointer& message) { callback(*message); }),
                                 ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

}  // namespace

SensorSubscriber::SensorSubscriber(ros::NodeHandle& node, const NodeSettings& settings, Sink sink)
    : settings_(settings), sink_(std::move(sink)), assembler_(settings.sensor) {
  using Kind = FrameAssembler::Sensor;
  if (settings.sensor != Kind::kCloud) subscribe_color(node);
  if (settings.sensor == Kind::kDepth) subscribe_depth(node);
  if (settings.sensor != Kind::kDepth) subscribe_cloud(node);
  for (const ros::Subscriber& subscriber : subscribers_) {
    topics_ += (topics_.empty() ? "" : ", ") + subscriber.getTopic();
  }
}

template <class Add>
void SensorSubscriber::take(const Add& add) {
  const std::scoped_lock lock(mutex_);
  try {
    add();
    if (settings_.sensor == FrameAssembler::Sensor::kCloudWithCamera) find_extrinsics();
    while (std::optional<Frame> frame = assembler_.next()) sink_(std::move(*frame));
  } catch (const Error& error) {
    ++damaged_;
    ROS_WARN_THROTTLE(kRepeat, "%s", error.what());
  }
}

void SensorSubscriber::subscribe_color(ros::NodeHandle& node) {
  const auto add = [this](const auto& message) {
    take([&] {
      color_frame_ = message.header.frame_id;
      if (settings_.sensor == FrameAssembler::Sensor::kDepth) frame_id_ = color_frame_;
      assembler_.add_color(message.header.stamp, color_of(message, "color image"));
    });
  };
  if (settings_.color_compressed) {
    subscribers_.push_back(
        subscribe_to<msg::CompressedImage>(node, "color/image_raw/compressed", add));
  } else {
    subscribers_.push_back(subscribe_to<msg::Image>(node, "color/image_raw", add));
  }
  const bool rectified = is_named_rectified(subscribers_.back().getTopic());  // as remapped
  subscribers_.push_back(subscribe_to<msg::CameraInfo>(
      node, "color/camera_info", [this, rectified](const auto& message) {
        take([&] { assembler_.set_camera(intrinsics_of(message, rectified, "camera_info")); });
      }));
}

void SensorSubscriber::subscribe_depth(ros::NodeHandle& node) {
  const auto add = [this](const auto& message) {
    take([&] { assembler_.add_depth(message.header.stamp, depth_of(message, "depth image")); });
  };
  if (settings_.depth_compressed) {
    subscribers_.push_back(
        subscribe_to<msg::CompressedImage>(node, "depth/image_raw/compressedDepth", add));
  } else {
    subscribers_.push_back(subscribe_to<msg::Image>(node, "depth/image_raw", add));
  }
}

void SensorSubscriber::subscribe_cloud(ros::NodeHandle& node) {
  subscribers_.push_back(
      subscribe_to<msg::PointCloud2>(node, "points", [this](const auto& message) {
        take([&] {
          frame_id_ = message.header.frame_id;
          assembler_.add_cloud(message.header.stamp,
                               scan_of(message, message.header.stamp, "cloud"));
        });
      }));
  if (settings_.sensor != FrameAssembler::Sensor::kCloudWithCamera) return;
  for (const char* topic : {"/tf_static", "/tf"}) {
    subscribers_.push_back(
        subscribe_to<msg::Transforms>(node, topic, [this](const msg::Transforms& message) {
          take([&] {
            if (!assembler_.extrinsics_known()) transforms_.add(message);
          });
        }));
  }
}

void SensorSubscriber::find_extrinsics() {
  if (assembler_.extrinsics_known() || color_frame_.empty() || frame_id_.empty()) return;
  const auto T_camera_lidar = transforms_.lookup(color_frame_, frame_id_, Timestamp());
  if (!T_camera_lidar) {
    ROS_WARN_THROTTLE(kRepeat, "no transform from '%s' to '%s' on /tf_static or /tf yet",
                      frame_id_.c_str(), color_frame_.c_str());
    return;
  }
  assembler_.set_extrinsics(Transform<Camera, Lidar>(*T_camera_lidar));
}

std::size_t SensorSubscriber::unmatched() {
  const std::scoped_lock lock(mutex_);
  return assembler_.unmatched();
}

std::size_t SensorSubscriber::damaged() {
  const std::scoped_lock lock(mutex_);
  return damaged_;
}

std::string SensorSubscriber::report(double seconds) {
  const std::scoped_lock lock(mutex_);
  return assembler_.report(seconds) + " (of " + topics_ + ")";
}

}  // namespace mms
