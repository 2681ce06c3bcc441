#include "mms/dataset/bag/bag_calibration.hpp"

#include "mms/core/error.hpp"
#include "mms/dataset/bag/bag_topics.hpp"
#include "mms/io/config/calibration_io.hpp"
#include "mms/ros/bag/bag_files.hpp"
#include "mms/ros/camera_messages.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// x.calibration.yaml of x.bag, or calibration.yaml of a folder.
fs::path calibration_file(const fs::path& bag) {
  if (fs::is_directory(bag)) return bag / "calibration.yaml";
  return bag_stem(bag).string() + ".calibration.yaml";
}

void read_camera(BagRecording& recording, const std::string& topic, Calibration& calibration,
                 const std::string& where) {
  if (topic.empty()) {
    throw DataError(where,
                    "has no sensor_msgs/CameraInfo for " + recording.color.topic + "; it has " +
                        listed(recording.bag->topics()),
                    "name its topic with --topic-camera-info, or add the camera to " +
                        calibration_file(where).filename().string());
  }
  const bool rectified = recording.color.topic.find("rect") != std::string::npos;
  calibration.camera = intrinsics_of(recording.bag->first<msg::CameraInfo>(topic), rectified,
                                     recording.bag->where(topic, 0));
  recording.facts.push_back("calibration: " + topic);
}

void read_extrinsics(BagRecording& recording, const TransformTree& transforms,
                     Calibration& calibration) {
  if (recording.cloud.empty() || recording.color.empty()) return;
  const auto T = transforms.lookup(recording.color.frame_id, recording.cloud.frame_id,
                                   recording.frames.front().stamp);
  const std::string frames = recording.cloud.frame_id + " to " + recording.color.frame_id;
  if (T) {
    calibration.T_camera_lidar = Transform<Camera, Lidar>(*T);
    recording.facts.push_back("extrinsics: " + frames + " from the recording's transforms");
  } else {
    recording.warnings.push_back("no transform from " + frames +
                                 ", assuming identical camera and LiDAR frames");
  }
}

/// The camera of depth images that have a frame and a camera_info of their own, and a transform to
/// the color images.
void read_depth_camera(BagRecording& recording, const TransformTree& transforms,
                       Calibration& calibration) {
  const BagStream& depth = recording.depth;
  if (depth.empty() || depth.frame_id == recording.color.frame_id) return;
  if (is_named_registered(depth.topic)) return;
  const std::string info = camera_info_beside(depth.topic);
  const auto T =
      transforms.lookup(recording.color.frame_id, depth.frame_id, recording.frames.front().stamp);
  if (!T || recording.bag->count(info) == 0) return;
  const bool rectified = depth.topic.find("rect") != std::string::npos;
  const CameraIntrinsics camera = intrinsics_of(recording.bag->read<msg::CameraInfo>(info, 0),
                                                rectified, recording.bag->where(info, 0));
  calibration.depth_camera = DepthCamera{camera, Transform<Camera, Depth>(*T)};
  recording.facts.push_back("depth: registered to the color images by " + info +
                            " and the transform from " + depth.frame_id + " to " +
                            recording.color.frame_id);
}

/// Transforms from the frames of wheels and gyroscope to that of the images or clouds.
void read_mounting(const BagRecording& recording, const BagTopicNames& topics,
                   const TransformTree& transforms, MotionCalibration& motion) {
  const BagStream& sensor = recording.cloud.empty() ? recording.color : recording.cloud;
  const auto lookup = [&](const std::string& frame) {
    return transforms.lookup(sensor.frame_id, frame, recording.frames.front().stamp);
  };
  if (!recording.motion.samples.wheels.empty()) {
    const auto T = lookup(recording.bag->first<msg::Odometry>(topics.wheels).child_frame_id);
    if (T) motion.T_sensor_base = Transform<Sensor, Base>(*T);
  }
  if (!recording.motion.samples.imu.empty()) {
    const auto T = lookup(recording.bag->first<msg::Imu>(topics.imu).header.frame_id);
    if (T) motion.T_sensor_imu = Transform<Sensor, Imu>(*T);
  }
}

}  // namespace

Calibration bag_calibration(BagRecording& recording, const BagTopicNames& topics,
                            const TransformTree& transforms, const fs::path& path,
                            const fs::path& given) {
  Calibration calibration;
  const fs::path file = given.empty() ? calibration_file(path) : given;
  if (!given.empty() || fs::exists(file)) {
    calibration = read_calibration(file);
    recording.facts.push_back("calibration: " + (given.empty() ? file.filename() : file).string());
  } else {
    read_extrinsics(recording, transforms, calibration);
  }
  if (!recording.color.empty() && !calibration.camera) {
    read_camera(recording, topics.camera_info, calibration, path.string());
    read_depth_camera(recording, transforms, calibration);
  }
  if (calibration.motion.empty()) read_mounting(recording, topics, transforms, calibration.motion);
  return calibration;
}

}  // namespace mms
