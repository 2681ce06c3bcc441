#include "interfaces/ros1/src/result_publisher.hpp"

#include "interfaces/ros1/src/ros_traits.hpp"
#include "mms/result_messages/result_messages.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {
namespace {

constexpr double kPathPeriod = 0.5;  // [s]

bool is_wanted(const ros::Publisher& publisher) {
  return publisher.getNumSubscribers() > 0;
}

bool has_passed(ros::WallTime& last, double period) {
  const ros::WallTime now = ros::WallTime::now();
  if ((now - last).toSec() < period) return false;
  last = now;
  return true;
}

}  // namespace

ResultPublisher::ResultPublisher(ros::NodeHandle& node, const NodeSettings& settings)
    : settings_(settings), robot_(settings.map_frame, settings.world_frame) {
  constexpr std::uint32_t kQueue = 100;
  constexpr std::uint32_t kLarge = 3;  // queue size of clouds and images
  ros::NodeHandle everywhere;
  odometry_ = node.advertise<msg::Odometry>("odometry", kQueue);
  if (settings.publish_tf) {
    transforms_ = everywhere.advertise<msg::Transforms>("/tf", kQueue);
    for (const char* topic : {"/tf_static", "/tf"}) {
      const boost::function<void(const boost::shared_ptr<const msg::Transforms>&)> add =
          [this](const boost::shared_ptr<const msg::Transforms>& message) { robot_.add(*message); };
      robot_topics_.push_back(everywhere.subscribe<msg::Transforms>(topic, kQueue, add));
    }
  }
  path_topic_ = node.advertise<msg::Path>("path", 1, true);
  static_cloud_ = node.advertise<msg::PointCloud2>("static_cloud", kLarge);
  dynamic_cloud_ = node.advertise<msg::PointCloud2>("dynamic_cloud", kLarge);
  map_ = node.advertise<msg::PointCloud2>("map", 1, true);
  markers_ = node.advertise<msg::MarkerArray>("object_markers", kQueue);
  objects_ = node.advertise<msg::Objects>("objects", kQueue);
  mask_ = node.advertise<msg::Image>("mask", kLarge);
}

void ResultPublisher::publish(const Processed& processed, const SlamSystem& system,
                              const std::string& sensor_frame) {
  const FrameResult& result = processed.result;
  const auto index = static_cast<std::uint32_t>(processed.frame.index);
  const msg::Header world{index, processed.frame.stamp, settings_.world_frame};
  const msg::Header sensor{index, processed.frame.stamp, sensor_frame};
  odometry_.publish(odometry_message(world, sensor_frame, result.odometry));
  if (settings_.publish_tf) publish_transforms(world, sensor_frame, result);
  publish_path(world, result);
  publish_clouds(sensor, result.cloud);
  publish_map(world, system);
  if (is_wanted(markers_)) markers_.publish(markers_message(world, result.objects));
  if (is_wanted(objects_)) objects_.publish(objects_message(world, result.objects));
}

void ResultPublisher::publish_transforms(const msg::Header& world, const std::string& sensor_frame,
                                         const FrameResult& result) {
  const FrameNames frames{settings_.map_frame, settings_.world_frame,
                          robot_.above(sensor_frame, world.stamp)};
  const bool is_camera = settings_.sensor == FrameAssembler::Sensor::kDepth;
  transforms_.publish(transforms_message(world, frames, result, is_camera));
}

void ResultPublisher::publish_path(const msg::Header& world, const FrameResult& result) {
  path_.add(world, pose_message(result.odometry.T_world_sensor.isometry()));
  if (is_wanted(path_topic_) && has_passed(last_path_, kPathPeriod)) {
    path_topic_.publish(path_.message());
  }
}

void ResultPublisher::publish_clouds(const msg::Header& sensor, const LabeledCloud& cloud) {
  if (is_wanted(static_cloud_)) {
    static_cloud_.publish(cloud_message(sensor, cloud, PointLabel::kStatic));
  }
  if (is_wanted(dynamic_cloud_)) {
    dynamic_cloud_.publish(cloud_message(sensor, cloud, PointLabel::kDynamic));
  }
  if (is_wanted(mask_) && !cloud.dynamic_pixels.empty()) {
    mask_.publish(mask_message(sensor, cloud));
  }
}

void ResultPublisher::publish_map(const msg::Header& world, const SlamSystem& system) {
  if (!is_wanted(map_) || !has_passed(last_map_, settings_.map_period)) return;
  map_.publish(cloud_message(world, system.static_map().cloud()));
}

void ResultPublisher::reset() {
  path_ = {};
}

}  // namespace mms
