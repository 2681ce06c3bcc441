#include "mms/dataset/bag/bag_calibration.hpp"

#include "mms/core/error.hpp"
#include "mms/dataset/bag/bag_topics.hpp"
#include "mms/dataset/bag/realsense_topics.hpp"
#include "mms/io/config/calibration_formats.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/ros/bag/bag_files.hpp"
#include "mms/ros/camera_messages.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr const char* kOwnFormat = "MMS-SLAM";  // of `read_any_calibration`

/// x.calibration.yaml of x.bag, or calibration.yaml of a folder.
fs::path calibration_file(const fs::path& bag) {
  if (fs::is_directory(bag)) return bag / "calibration.yaml";
  return bag_stem(bag).string() + ".calibration.yaml";
}

/// The given file, or that beside the bag; nullopt for none.
std::optional<FormattedCalibration> read_calibration_file(BagRecording& recording,
                                                          const fs::path& bag,
                                                          const fs::path& given) {
  const fs::path file = given.empty() ? calibration_file(bag) : given;
  if (given.empty() && !fs::exists(file)) return std::nullopt;
  const FormattedCalibration read = read_any_calibration(file);
  recording.facts.push_back("calibration: " + (given.empty() ? file.filename() : file).string() +
                            (read.format == kOwnFormat ? "" : " (" + read.format + ")"));
  return read;
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
  const bool rectified = is_named_rectified(recording.color.topic);
  calibration.camera = intrinsics_of(recording.bag->first<msg::CameraInfo>(topic), rectified,
                                     recording.bag->where(topic, 0));
  recording.facts.push_back("calibration: " + topic);
}

/// The images beside clouds are not needed: without their camera they are left out.
void read_camera_beside_clouds(BagRecording& recording, const std::string& topic,
                               Calibration& calibration, const std::string& where) {
  try {
    read_camera(recording, topic, calibration, where);
  } catch (const DataError& error) {
    recording.warnings.push_back("the images of " + recording.color.topic +
                                 " are not used: " + error.what());
    recording.color = {};
    recording.mask = {};
    for (BagFrame& frame : recording.frames) frame.color = BagFrame::kNone;
  }
}

/// Whether the user asks for images, so that their camera must be known.
bool wants_images(const SourceOptions& options) {
  return !options.topics.color.empty() || !options.topics.camera_info.empty() ||
         !options.topics.mask.empty() || !options.masks.empty();
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

/// Depth images of RealSense's SDK, which are never registered.
void read_realsense_depth_camera(BagRecording& recording, Calibration& calibration) {
  const BagReader& bag = *recording.bag;
  const std::string& depth = recording.depth.topic;
  const std::string info = realsense_camera_info(depth);
  const auto T = realsense_extrinsics(bag, recording.color.topic, depth);
  if (!T || bag.count(info) == 0) {
    recording.warnings.push_back("the depth of " + depth +
                                 " is taken as registered to the color images, but RealSense's SDK "
                                 "records it unregistered, and the bag has no " +
                                 (T ? info : "extrinsics of both streams (tf/0)") +
                                 "; add depth_camera to a calibration file");
    return;
  }
  const CameraIntrinsics camera =
      intrinsics_of(bag.first<msg::CameraInfo>(info), false, bag.where(info, 0));
  calibration.depth_camera = DepthCamera{camera, *T};
  recording.facts.push_back("depth: registered to the color images by " + info +
                            " and the extrinsics of RealSense's SDK");
}

/// The camera of depth images that have a frame and a camera_info of their own, and a transform to
/// the color images.
void read_depth_camera(BagRecording& recording, const TransformTree& transforms,
                       Calibration& calibration) {
  const BagStream& depth = recording.depth;
  if (depth.empty()) return;
  if (is_realsense_stream(depth.topic)) return read_realsense_depth_camera(recording, calibration);
  if (depth.frame_id == recording.color.frame_id) return;
  if (is_named_registered(depth.topic)) return;
  const std::string info = camera_info_beside(depth.topic);
  const auto T =
      transforms.lookup(recording.color.frame_id, depth.frame_id, recording.frames.front().stamp);
  if (!T || recording.bag->count(info) == 0) {
    recording.warnings.push_back(
        "the depth of " + depth.topic +
        " is taken as registered to the color images, but its "
        "frame is '" +
        depth.frame_id + "', theirs is '" + recording.color.frame_id + "', and the bag has no " +
        (T ? info : "transform between them (/tf_static)") +
        "; if it is not registered, add depth_camera to a calibration file");
    return;
  }
  const bool rectified = is_named_rectified(depth.topic);
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

/// Whether depth images have numbers in meters, which need no scale.
bool is_in_meters(const BagRecording& recording) {
  const BagReader& bag = *recording.bag;
  const std::string& topic = recording.depth.topic;
  const std::string encoding = recording.depth.compressed
                                   ? bag.first<msg::CompressedImage>(topic).format
                                   : bag.first<msg::Image>(topic).encoding;
  return encoding.starts_with("32FC1");
}

/// Sets the units per meter of integer depth, see `bag_calibration`.
void choose_depth_scale(BagRecording& recording, const std::optional<FormattedCalibration>& file,
                        const std::optional<double>& given, Calibration& calibration) {
  const std::string& topic = recording.depth.topic;
  if (recording.depth.empty()) return;
  if (given && is_in_meters(recording)) {
    recording.warnings.push_back("--depth-scale has no effect: the depth of " + topic +
                                 " is in meters (32FC1)");
  } else if (given) {
    calibration.depth_scale = *given;
    recording.facts.push_back("depth scale: given, " + format_number(*given));
  } else if (file && file->calibration.camera && !file->assumed_depth_scale) {
    return;  // it is that of the file
  } else if (const auto scale = realsense_depth_scale(*recording.bag, topic)) {
    calibration.depth_scale = *scale;
    recording.facts.push_back("depth scale: " + format_number(*scale) +
                              " units per meter, by the option Depth_Units");
  } else if (file && file->assumed_depth_scale) {
    recording.facts.emplace_back("depth scale: none, 1000 units per meter assumed");
  }
}

}  // namespace

Calibration bag_calibration(BagRecording& recording, const BagTopicNames& topics,
                            const TransformTree& transforms, const fs::path& path,
                            const SourceOptions& options) {
  const auto file = read_calibration_file(recording, path, options.camera.file);
  Calibration calibration = file ? file->calibration : Calibration();
  if (!recording.color.empty() && !calibration.camera) {
    if (recording.cloud.empty() || wants_images(options)) {
      read_camera(recording, topics.camera_info, calibration, path.string());
    } else {
      read_camera_beside_clouds(recording, topics.camera_info, calibration, path.string());
    }
    read_depth_camera(recording, transforms, calibration);
  } else if (is_realsense_stream(recording.depth.topic) && !calibration.depth_camera) {
    read_realsense_depth_camera(recording, calibration);
  }
  // Files of other formats have no place for the LiDAR.
  if (!file || file->format != kOwnFormat) read_extrinsics(recording, transforms, calibration);
  choose_depth_scale(recording, file, options.camera.depth_scale, calibration);
  if (calibration.motion.empty()) read_mounting(recording, topics, transforms, calibration.motion);
  return calibration;
}

}  // namespace mms
