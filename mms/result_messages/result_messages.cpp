#include "mms/result_messages/result_messages.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include "mms/core/image.hpp"
#include "mms/ros/image_messages.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {
namespace {

constexpr std::uint8_t kFloat32 = 7;

/// Writes a cloud of x, y, z and rgb for RViz: b, g, r in the bytes of a float.
class CloudWriter {
 public:
  CloudWriter(const msg::Header& header, bool colored) {
    message_.header = header;
    message_.height = 1;
    message_.is_dense = true;
    for (const char* name : {"x", "y", "z"}) add_field(name);
    if (colored) add_field("rgb");
  }

  void add(const Eigen::Vector3f& point, const Rgb* color) {
    const std::size_t at = message_.data.size();
    message_.data.resize(at + message_.point_step);
    std::memcpy(message_.data.data() + at, point.data(), 3 * sizeof(float));
    if (color == nullptr) return;
    const std::uint8_t bytes[4] = {color->b, color->g, color->r, 0};
    std::memcpy(message_.data.data() + at + 3 * sizeof(float), bytes, sizeof bytes);
  }

  msg::PointCloud2 finish() {
    message_.width = static_cast<std::uint32_t>(message_.data.size() / message_.point_step);
    message_.row_step = static_cast<std::uint32_t>(message_.data.size());
    return std::move(message_);
  }

 private:
  void add_field(const char* name) {
    message_.point_fields.push_back({name, message_.point_step, kFloat32, 1});
    message_.point_step += sizeof(float);
  }

  msg::PointCloud2 message_;
};

std::array<double, 3> array_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

std::string text_of(const ObjectBox& box) {
  char text[64];
  const std::string name(to_string(box.object_class));
  std::snprintf(text, sizeof text, "%s %d  %.1f m/s", name.c_str(), box.id, box.velocity.norm());
  return text;
}

msg::Marker box_marker(const msg::Header& header, const ObjectBox& box) {
  constexpr std::array<float, 4> kColors[kTrackedClassCount] = {
      {0.9F, 0.1F, 0.1F, 0.5F}, {0.1F, 0.8F, 0.2F, 0.5F}, {1.0F, 0.7F, 0.1F, 0.5F}};
  msg::Marker marker;
  marker.header = header;
  marker.ns = "boxes";
  marker.id = box.id;
  marker.pose = pose_message(box.T_world_box);
  marker.scale = array_of(box.size);
  marker.color = kColors[static_cast<int>(box.object_class)];
  return marker;
}

msg::Marker text_marker(const msg::Header& header, const ObjectBox& box) {
  constexpr double kHeight = 0.2;  // text height [m]
  msg::Marker marker;
  marker.header = header;
  marker.ns = "names";
  marker.id = box.id;
  marker.type = msg::Marker::kText;
  const Eigen::Vector3d above(0.0, 0.0, 0.5 * box.size.z() + kHeight);
  marker.pose.position = array_of(box.T_world_box * above);
  marker.scale = {0.0, 0.0, kHeight};
  marker.color = {1.0F, 1.0F, 1.0F, 1.0F};
  marker.text = text_of(box);
  return marker;
}

}  // namespace

Eigen::Isometry3d level_map_pose(bool is_camera) {
  Eigen::Isometry3d T_map_global = Eigen::Isometry3d::Identity();
  if (is_camera) T_map_global.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // x right, y down, z ahead
  return T_map_global;
}

msg::Transforms transforms_message(const msg::Header& header, const FrameNames& frames,
                                   const FrameResult& result, bool is_camera) {
  msg::Header world = header;
  world.frame_id = frames.world;
  const Eigen::Isometry3d T_world_robot =
      result.odometry.T_world_sensor.isometry() * frames.robot.T_sensor_frame;
  msg::Transforms message{{{world, frames.robot.frame, pose_message(T_world_robot)}}};
  if (!result.correction.T_global_world) return message;
  msg::Header map = header;
  map.frame_id = frames.map;
  const Eigen::Isometry3d T_map_world =
      level_map_pose(is_camera) * result.correction.T_global_world->isometry();
  message.transforms.push_back({map, frames.world, pose_message(T_map_world)});
  return message;
}

msg::Odometry odometry_message(const msg::Header& header, const std::string& child_frame,
                               const OdometryEstimate& odometry) {
  msg::Odometry message;
  message.header = header;
  message.child_frame_id = child_frame;
  message.pose = pose_message(odometry.T_world_sensor.isometry());
  constexpr double kFloor =
      1e-6;  // added to the information, so that degenerate directions have a covariance
  const Eigen::Matrix<double, 6, 6> information =
      odometry.information + kFloor * Eigen::Matrix<double, 6, 6>::Identity();
  Eigen::Matrix<double, 6, 6> rotation = Eigen::Matrix<double, 6, 6>::Zero();
  rotation.topLeftCorner<3, 3>() = odometry.T_world_sensor.rotation();
  rotation.bottomRightCorner<3, 3>() = odometry.T_world_sensor.rotation();
  const Eigen::Matrix<double, 6, 6> covariance =
      rotation * information.inverse() * rotation.transpose();
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      message.pose_covariance[static_cast<std::size_t>(6 * row + column)] = covariance(row, column);
    }
  }
  return message;
}

msg::PointCloud2 cloud_message(const msg::Header& header, const LabeledCloud& cloud,
                               PointLabel label) {
  const bool colored = !cloud.colors.empty();
  CloudWriter writer(header, colored);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] != label) continue;
    writer.add(cloud.points[i], colored ? &cloud.colors[i] : nullptr);
  }
  return writer.finish();
}

msg::PointCloud2 cloud_message(const msg::Header& header, const MapCloud& map) {
  CloudWriter writer(header, true);
  for (std::size_t i = 0; i < map.size(); ++i) writer.add(map.points[i], &map.colors[i]);
  return writer.finish();
}

msg::Image mask_message(const msg::Header& header, const LabeledCloud& cloud) {
  Image<std::uint8_t> mask = cloud.dynamic_pixels;
  for (std::uint8_t& pixel : mask.pixels()) pixel = pixel == 0 ? 0 : 255;
  return image_message(header, mask);
}

msg::Objects objects_message(const msg::Header& header, const std::vector<TrackedObject>& objects) {
  msg::Objects message;
  message.header = header;
  for (const TrackedObject& object : objects) {
    const ObjectBox& box = object.box;
    message.objects.push_back(
        {static_cast<std::uint32_t>(box.id), static_cast<std::uint8_t>(box.object_class),
         static_cast<float>(box.score), box.moving, pose_message(box.T_world_box),
         array_of(box.size), array_of(box.velocity)});
  }
  return message;
}

msg::MarkerArray markers_message(const msg::Header& header,
                                 const std::vector<TrackedObject>& objects) {
  msg::MarkerArray message;
  msg::Marker clear;
  clear.header = header;
  clear.action = msg::Marker::kDeleteAll;
  message.markers.push_back(clear);
  for (const TrackedObject& object : objects) {
    message.markers.push_back(box_marker(header, object.box));
    message.markers.push_back(text_marker(header, object.box));
  }
  return message;
}

msg::DiagnosticArray diagnostics_message(const msg::Header& header, const FrameResult& result,
                                         double read_ms) {
  msg::DiagnosticStatus status;
  status.name = "mms-slam";
  status.message = to_string(result.odometry.status);
  if (result.odometry.status == Status::kDegenerate) status.level = msg::DiagnosticStatus::kWarn;
  if (result.odometry.status == Status::kLost) status.level = msg::DiagnosticStatus::kError;
  const auto add = [&](std::string key, double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", value);
    status.values.push_back({std::move(key), text});
  };
  add("dynamic_share", result.dynamic_share);
  add("overruled_share", result.overruled_share);
  add("objects", static_cast<double>(result.objects.size()));
  add("read_ms", read_ms);
  for (std::size_t i = 0; i < kStageCount; ++i) {
    add(std::string(to_string(static_cast<Stage>(i))) + "_ms", result.stage_ms[i]);
  }
  return {header, {std::move(status)}};
}

}  // namespace mms
