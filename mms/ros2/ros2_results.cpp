#include "mms/ros2/ros2_results.hpp"

#include <sstream>
#include <utility>

#include "mms/pipeline/live_map.hpp"
#include "mms/result_messages/result_messages.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {
namespace {

constexpr double kPathPeriod = 0.5;  // [s]

template <class Number>
msg::KeyValue key_value(const char* key, const Number& number) {
  std::ostringstream text;
  text << number;
  return {key, text.str()};
}

bool is_due(std::chrono::steady_clock::time_point& last, double period) {
  const auto now = std::chrono::steady_clock::now();
  if (std::chrono::duration<double>(now - last).count() < period) return false;
  last = now;
  return true;
}

}  // namespace

Ros2Results::Ros2Results(Ros2Node& node, const Ros2ResultOptions& options)
    : options_(options),
      node_name_(node.full_name()),
      robot_(options.map_frame, options.world_frame) {
  using Reliability = TopicQos::Reliability;
  const TopicQos small{Reliability::kReliable, false, 100};
  // With a history of a few messages Fast DDS readers lost most large ones; so all are kept until
  // they are read, or their writer would wait for longer than 0.1 s.
  const TopicQos large{Reliability::kReliable, false, 0};
  const TopicQos latest{Reliability::kReliable, true, 1};
  odometry_ = node.advertise<msg::Odometry>("~/odometry", small);
  if (options.transforms) {
    transforms_ = node.advertise<msg::Transforms>(options.transforms_topic, small);
    const auto add = [this](const msg::Transforms& message) { robot_.add(message); };
    node.subscribe<msg::Transforms>(options.transforms_topic + "_static",
                                    {Reliability::kReliable, true, 100}, add);
    node.subscribe<msg::Transforms>(options.transforms_topic,
                                    {Reliability::kAsPublishers, false, 100}, add);
  }
  path_topic_ = node.advertise<msg::Path>("~/path", latest);
  static_cloud_ = node.advertise<msg::PointCloud2>("~/static_cloud", large);
  dynamic_cloud_ = node.advertise<msg::PointCloud2>("~/dynamic_cloud", large);
  map_ = node.advertise<msg::PointCloud2>("~/map", latest);
  markers_ = node.advertise<msg::MarkerArray>("~/object_markers", small);
  objects_ = node.advertise<msg::Objects>("~/objects", small);
  mask_ = node.advertise<msg::Image>("~/mask", large);
  diagnostics_ = node.advertise<msg::DiagnosticArray>("/diagnostics", small);
}

void Ros2Results::publish(const Processed& processed, const SlamSystem& system,
                          const std::string& sensor_frame, bool is_camera) {
  const FrameResult& result = processed.result;
  const auto index = static_cast<std::uint32_t>(processed.frame.index);
  const msg::Header world{index, processed.frame.stamp, options_.world_frame};
  const msg::Header sensor{index, processed.frame.stamp, sensor_frame};
  odometry_.publish(odometry_message(world, sensor_frame, result.odometry));
  if (options_.transforms) {
    const FrameNames frames{options_.map_frame, options_.world_frame,
                            robot_.above(sensor_frame, processed.frame.stamp)};
    transforms_.publish(transforms_message(world, frames, result, is_camera));
  }
  publish_path(world, result.odometry);
  publish_clouds(sensor, result.cloud);
  if (map_.is_wanted() && is_due(last_map_, options_.map_period)) {
    map_.publish(cloud_message(world, live_map(system.mapping(), result)));
  }
  if (markers_.is_wanted()) markers_.publish(markers_message(world, result.objects));
  if (objects_.is_wanted()) objects_.publish(objects_message(world, result.objects));
  const std::scoped_lock lock(mutex_);
  last_ = diagnostics_message(world, result, processed.read_ms);
  ++frames_;
}

void Ros2Results::publish_path(const msg::Header& world, const OdometryEstimate& odometry) {
  path_.add(world, pose_message(odometry.T_world_sensor.isometry()));
  if (path_topic_.is_wanted() && is_due(last_path_, kPathPeriod)) {
    path_topic_.publish(path_.message());
  }
}

void Ros2Results::publish_clouds(const msg::Header& sensor, const LabeledCloud& cloud) {
  if (static_cloud_.is_wanted()) {
    static_cloud_.publish(cloud_message(sensor, cloud, PointLabel::kStatic));
  }
  if (dynamic_cloud_.is_wanted()) {
    dynamic_cloud_.publish(cloud_message(sensor, cloud, PointLabel::kDynamic));
  }
  if (mask_.is_wanted() && !cloud.dynamic_pixels.empty()) {
    mask_.publish(mask_message(sensor, cloud));
  }
}

void Ros2Results::diagnose(const std::string& inputs, const Ros2InputCounts& counts) {
  const std::scoped_lock lock(mutex_);
  const std::chrono::duration<double> passed = Clock::now() - diagnosed_;
  diagnosed_ += std::chrono::duration_cast<Clock::duration>(passed);
  const std::size_t frames = frames_ - std::exchange(reported_, frames_);
  msg::DiagnosticStatus status;
  status.name = node_name_ + ": inputs";
  status.message = frames > 0 ? "frames arrive" : "no frames: " + inputs;
  if (frames == 0) status.level = msg::DiagnosticStatus::kWarn;
  status.values = {key_value("frames/s", static_cast<double>(frames) / passed.count()),
                   key_value("frames", frames_),
                   key_value("frames dropped", counts.dropped),
                   key_value("frames not later", counts.not_later),
                   key_value("frames incomplete", counts.incomplete),
                   key_value("images unmatched", counts.unmatched),
                   key_value("messages damaged", counts.damaged),
                   {"inputs", inputs}};
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  msg::DiagnosticArray message;
  message.header.stamp =
      Timestamp(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
  message.status.push_back(std::move(status));
  if (last_) {
    message.status.push_back(last_->status.front());
    message.status.back().name = node_name_ + ": pose";
  }
  diagnostics_.publish(message);
}

}  // namespace mms
