#include "mms/run/record/run_recorder.hpp"

#include <fmt/core.h>

#include <exception>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/result_messages/result_messages.hpp"
#include "mms/ros/camera_messages.hpp"
#include "mms/ros/image_messages.hpp"
#include "mms/ros/storage/mcap_writer.hpp"
#include "mms/ros/transform_tree.hpp"
#include "mms/run/record/overlay.hpp"

namespace mms {
namespace {

constexpr std::size_t kRecorderQueue = 16;  // frames, half a second
constexpr int kOverlayQuality = 85;         // of JPEG

/// Whether something that is recorded as a whole grew by a tenth, so that all records together are
/// at most eleven times the last.
bool has_grown(std::size_t size, std::size_t recorded) {
  return 10 * size > 11 * recorded;
}

}  // namespace

RunRecorder::RunRecorder(const std::filesystem::path& folder, WarningHandler warn)
    : warn_(std::move(warn)),
      file_(std::make_unique<McapWriter>(folder / kRecordingName)),
      queue_(kRecorderQueue),
      thread_([this] { write_entries(); }) {}

RunRecorder::~RunRecorder() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

void RunRecorder::add(const Processed& processed, const StaticMap& map) {
  auto entry = std::make_unique<Entry>();
  entry->stamp = last_ = processed.frame.stamp;
  entry->index = static_cast<std::uint32_t>(processed.frame.index);
  entry->result = processed.result;
  entry->read_ms = processed.read_ms;
  if (processed.result.keyframe && has_grown(map.size(), recorded_points_)) {
    entry->map = map.cloud();
    recorded_points_ = map.size();
  }
  queue_.push(std::move(entry));
}

void RunRecorder::finish(MapCloud map, Trajectory corrected) {
  auto entry = std::make_unique<Entry>();
  entry->stamp = last_;
  entry->map = std::move(map);
  entry->corrected = std::move(corrected);
  queue_.push(std::move(entry));
  queue_.close();
  thread_.join();
  if (!file_) return;
  try {
    file_->finish();
  } catch (const std::exception& error) {
    warn_(error.what());
  }
}

void RunRecorder::write_entries() {
  try {
    while (const auto entry = queue_.pop()) write(**entry);
  } catch (const std::exception& error) {  // including lack of memory
    queue_.close();
    file_.reset();
    warn_(fmt::format("{}; the run continues without {}", error.what(), kRecordingName));
  }
}

void RunRecorder::write(const Entry& entry) {
  if (!entry.result) return write_end(entry);
  write_frame(entry, *entry.result);
  if (!entry.map) return;
  file_->write("/map", entry.stamp, cloud_message(header_of(entry, frames_.world), *entry.map));
}

void RunRecorder::write_end(const Entry& entry) {
  const msg::Header world = header_of(entry, frames_.world);
  write_path("/path", world, path_);
  if (entry.corrected.empty()) {
    file_->write("/map", entry.stamp, cloud_message(world, *entry.map));
    return;
  }
  const Eigen::Isometry3d T_map_global = level_map_pose(is_camera_);
  const MapCloud map = moved(*entry.map, std::vector<Timestamp>(entry.map->size()),
                             [&](Timestamp) { return T_map_global; });
  Trajectory corrected = entry.corrected;
  for (StampedPose& pose : corrected) {
    pose.T_world_sensor = Transform<World, Sensor>(T_map_global * pose.T_world_sensor.isometry());
  }
  const msg::Header level = header_of(entry, frames_.map);
  write_path("/path_corrected", level, corrected);
  file_->write("/map", entry.stamp, cloud_message(level, map));
}

void RunRecorder::write_frame(const Entry& entry, const FrameResult& result) {
  is_camera_ = result.cloud.organised();
  frames_.robot.frame = is_camera_ ? "camera" : "lidar";
  const msg::Header world = header_of(entry, frames_.world);
  const msg::Header sensor = header_of(entry, frames_.robot.frame);
  file_->write("/tf", entry.stamp, transforms_message(world, frames_, result, is_camera_));
  file_->write("/odometry", entry.stamp,
               odometry_message(world, frames_.robot.frame, result.odometry));
  path_.push_back({entry.stamp, result.odometry.T_world_sensor});
  if (has_grown(path_.size(), recorded_poses_)) {
    write_path("/path", world, path_);
    recorded_poses_ = path_.size();
  }
  if (result.cloud.organised() && !result.cloud.colors.empty()) {
    file_->write("/overlay/compressed", entry.stamp,
                 compressed_message(sensor, draw_overlay(result.cloud), kOverlayQuality));
    file_->write("/overlay/camera_info", entry.stamp,
                 camera_info_message(sensor, result.cloud.camera));
  }
  if (result.keyframe) {
    file_->write("/static_cloud", entry.stamp,
                 cloud_message(sensor, result.cloud, PointLabel::kStatic));
  }
  file_->write("/dynamic_cloud", entry.stamp,
               cloud_message(sensor, result.cloud, PointLabel::kDynamic));
  file_->write("/object_markers", entry.stamp, markers_message(world, result.objects));
  file_->write("/objects", entry.stamp, objects_message(world, result.objects));
  file_->write("/diagnostics", entry.stamp, diagnostics_message(world, result, entry.read_ms));
}

void RunRecorder::write_path(const std::string& topic, const msg::Header& header,
                             const Trajectory& poses) {
  msg::Path path;
  path.header = header;
  for (const StampedPose& pose : poses) {
    path.poses.push_back(
        {{header.seq, pose.stamp, header.frame_id}, pose_message(pose.T_world_sensor.isometry())});
  }
  file_->write(topic, header.stamp, path);
}

msg::Header RunRecorder::header_of(const Entry& entry, const std::string& frame_id) const {
  return {entry.index, entry.stamp, frame_id};
}

}  // namespace mms
