#include "mms/ros2/ros2_source.hpp"

#include <algorithm>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/result_messages/result_messages.hpp"
#include "mms/ros/camera_messages.hpp"
#include "mms/ros/cloud_messages.hpp"
#include "mms/ros/image_messages.hpp"
#include "mms/ros/motion_messages.hpp"

namespace mms {
namespace {

constexpr double kPoll = 0.1;               // between checks of the end and of waiting frames [s]
constexpr std::size_t kMaxMasks = 60;       // that wait for their frames
constexpr std::size_t kMaxMotion = 10'000;  // samples that wait for frames: 10 s at 1 kHz
constexpr auto kMaxWait = std::chrono::milliseconds(500);  // of a frame for masks and motion
constexpr auto kMountingWait = std::chrono::seconds(2);    // of the first one for transforms

FrameAssembler::Sensor sensor_of(const Ros2Inputs& inputs) {
  if (inputs.points.empty()) return FrameAssembler::Sensor::kDepth;
  return inputs.color.empty() ? FrameAssembler::Sensor::kCloud
                              : FrameAssembler::Sensor::kCloudWithCamera;
}

/// Of sensors, with so many messages that may wait.
TopicQos sensor_qos(int depth) {
  return {TopicQos::Reliability::kAsPublishers, false, depth};
}

template <class Sample>
void add_sample(std::deque<Sample>& samples, Sample sample) {
  if (!samples.empty() && sample.stamp <= samples.back().stamp) return;
  samples.push_back(std::move(sample));
  if (samples.size() > kMaxMotion) samples.pop_front();
}

template <class Sample>
std::vector<Sample> take_samples(std::deque<Sample>& samples, Timestamp end) {
  auto last = samples.begin();
  while (last != samples.end() && last->stamp <= end) ++last;
  std::vector<Sample> taken(samples.begin(), last);
  samples.erase(samples.begin(), last);
  return taken;
}

}  // namespace

Ros2Source::Ros2Source(Ros2Node& node, const Ros2Inputs& inputs, std::size_t queue,
                       std::function<bool()> stop, std::function<void()> on_clock_back)
    : LiveSource(queue),
      node_(node),
      inputs_(inputs),
      stop_(std::move(stop)),
      on_clock_back_(std::move(on_clock_back)),
      assembler_(sensor_of(inputs)),
      depth_known_(inputs.depth_info.empty()) {
  if (!inputs_.color.empty()) subscribe_color();
  if (is_camera()) {
    subscribe_depth();
  } else {
    subscribe_points();
  }
  subscribe_motion();
  if (!is_placed() || !is_mounted()) subscribe_transforms();
  if (!inputs_.initial_pose.empty()) subscribe_initial_pose();
  node_.every(kPoll, [this] {
    if (stop_()) close();
    advance();
  });
}

void Ros2Source::subscribe_color() {
  const auto add = [this](const auto& message) {
    color_frame_ = message.header.frame_id;
    assembler_.add_color(message.header.stamp, color_of(message, "color image"));
    advance();
  };
  const TopicQos qos = sensor_qos(30);
  if (inputs_.color.ends_with("/compressed")) {
    node_.subscribe<msg::CompressedImage>(inputs_.color, qos, add);
  } else {
    node_.subscribe<msg::Image>(inputs_.color, qos, add);
  }
  node_.subscribe<msg::CameraInfo>(
      inputs_.camera_info, qos, [this](const msg::CameraInfo& message) {
        const bool rectified = is_named_rectified(inputs_.color);
        assembler_.set_camera(intrinsics_of(message, rectified, "camera_info"));
        advance();
      });
  if (inputs_.mask.empty()) return;
  node_.subscribe<msg::Image>(inputs_.mask, qos, [this](const msg::Image& message) {
    masks_.emplace_back(message.header.stamp, mask_of(message, "mask"));
    if (masks_.size() > kMaxMasks) masks_.pop_front();
    advance();
  });
}

void Ros2Source::subscribe_depth() {
  const auto add = [this](const auto& message) {
    depth_frame_ = message.header.frame_id;
    assembler_.add_depth(message.header.stamp, depth_of(message, "depth image"));
    advance();
  };
  if (inputs_.depth.ends_with("/compressedDepth")) {
    node_.subscribe<msg::CompressedImage>(inputs_.depth, sensor_qos(30), add);
  } else {
    node_.subscribe<msg::Image>(inputs_.depth, sensor_qos(30), add);
  }
  if (depth_known_) return;
  node_.subscribe<msg::CameraInfo>(
      inputs_.depth_info, sensor_qos(30), [this](const msg::CameraInfo& message) {
        const bool rectified = is_named_rectified(inputs_.depth);
        depth_camera_ = intrinsics_of(message, rectified, "camera_info of the depth images");
        advance();
      });
}

void Ros2Source::subscribe_points() {
  node_.subscribe<msg::PointCloud2>(
      inputs_.points, sensor_qos(30), [this](const msg::PointCloud2& message) {
        cloud_frame_ = message.header.frame_id;
        LidarScan scan = scan_of(message, message.header.stamp, "cloud");
        if (scan.points.empty()) throw DataError("cloud", "has no points");
        assembler_.add_cloud(message.header.stamp, std::move(scan));
        advance();
      });
}

void Ros2Source::subscribe_motion() {
  constexpr int kQueue = 1000;  // a second of a fast gyroscope
  if (!inputs_.imu.empty()) {
    node_.subscribe<msg::Imu>(inputs_.imu, sensor_qos(kQueue), [this](const msg::Imu& message) {
      imu_frame_ = message.header.frame_id;
      const ImuSample sample = sample_of(message);
      if (sample.rate.allFinite()) add_sample(imu_, sample);
      advance();
    });
  }
  if (inputs_.wheels.empty()) return;
  node_.subscribe<msg::Odometry>(inputs_.wheels, sensor_qos(kQueue),
                                 [this](const msg::Odometry& message) {
                                   wheel_frame_ = message.child_frame_id;
                                   const WheelSample sample = sample_of(message);
                                   if (sample.T_odom_base.is_finite()) add_sample(wheels_, sample);
                                   advance();
                                 });
}

void Ros2Source::subscribe_transforms() {
  const auto add = [this](const msg::Transforms& message) {
    // Those of a moving robot would fill the memory; mountings do not change.
    if (!is_placed() || !is_mounted()) transforms_.add(message);
    advance();
  };
  node_.subscribe<msg::Transforms>(inputs_.transforms + "_static",
                                   {TopicQos::Reliability::kReliable, true, 100}, add);
  node_.subscribe<msg::Transforms>(inputs_.transforms, sensor_qos(100), add);
}

/// The pose is taken as that of the sensor, x forward and z up.
void Ros2Source::subscribe_initial_pose() {
  node_.subscribe<msg::PoseWithCovarianceStamped>(
      inputs_.initial_pose, {}, [this](const msg::PoseWithCovarianceStamped& message) {
        const std::string& frame = message.header.frame_id;
        const Eigen::Isometry3d T_map_body = isometry_of(message.pose);
        if (frame != inputs_.map_frame || !T_map_body.matrix().allFinite()) {
          throw DataError("initial pose", frame != inputs_.map_frame
                                              ? "is in the frame '" + frame + "', allowed: '" +
                                                    inputs_.map_frame + "'"
                                              : "has values that are not finite");
        }
        const Eigen::Isometry3d T_map_global = level_map_pose(is_camera());
        const Eigen::Isometry3d T_body_sensor(T_map_global.linear());
        expected_place_ =
            Transform<Global, Sensor>(T_map_global.inverse() * T_map_body * T_body_sensor);
      });
}

/// Moves on what has become complete.
void Ros2Source::advance() {
  const auto hand_on = [this] {
    while (!pending_.empty() && is_complete(pending_.front())) {
      Pending pending = std::move(pending_.front());
      pending_.pop_front();
      release(std::move(pending));
    }
  };
  try {
    take_frames();
  } catch (const Error&) {
    hand_on();
    throw;
  }
  hand_on();
}

void Ros2Source::take_frames() {
  if (!is_placed() && !(is_camera() ? find_depth_camera() : find_extrinsics())) return;
  while (std::optional<Frame> frame = assembler_.next()) {
    if (last_stamp_ && frame->stamp + FrameAssembler::kMaxStepBack < *last_stamp_) {
      on_clock_back_();
      return;
    }
    if (last_stamp_ && frame->stamp <= *last_stamp_) {
      warn("frame " + frame->name + " skipped: its stamp is not later than the previous one, " +
           last_stamp_->to_string());
      const std::scoped_lock lock(mutex_);
      ++counts_.not_later;
      continue;
    }
    last_stamp_ = frame->stamp;
    pending_.push_back({std::move(*frame), assembler_.color_stamp(), Clock::now()});
  }
}

/// Whether the place of the depth or LiDAR sensor beside the color camera is known, or not needed.
bool Ros2Source::is_placed() const {
  if (is_camera()) return depth_known_;
  return inputs_.color.empty() || assembler_.extrinsics_known();
}

/// Depth images in the frame of the color images are registered; others need their camera.
bool Ros2Source::find_depth_camera() {
  if (color_frame_.empty() || depth_frame_.empty()) return false;
  if (color_frame_ != depth_frame_) {
    const auto T = transforms_.lookup(color_frame_, depth_frame_, Timestamp());
    if (!depth_camera_ || !T) return false;
    assembler_.set_depth_camera({*depth_camera_, Transform<Camera, Depth>(*T)});
  }
  return depth_known_ = true;
}

bool Ros2Source::find_extrinsics() {
  if (color_frame_.empty() || cloud_frame_.empty()) return false;
  const auto T = transforms_.lookup(color_frame_, cloud_frame_, Timestamp());
  if (T) assembler_.set_extrinsics(Transform<Camera, Lidar>(*T));
  return T.has_value();
}

/// Searches what is not known yet: a driver may start after the first frame.
void Ros2Source::find_mounting(Timestamp stamp) {
  const std::string& sensor = is_camera() ? color_frame_ : cloud_frame_;
  const auto find = [&](const std::string& frame, auto& T_sensor_frame) {
    if (T_sensor_frame || frame.empty()) return;
    const auto found = transforms_.lookup(sensor, frame, stamp);
    if (!found) return;
    T_sensor_frame.emplace(*found);
    received_.reset();  // the calibration of the frames from here on has it
  };
  if (!inputs_.wheels.empty()) find(wheel_frame_, mounting_.T_sensor_base);
  if (!inputs_.imu.empty()) find(imu_frame_, mounting_.T_sensor_imu);
}

void Ros2Source::warn_of_mounting(const std::string& topic, const std::string& frame) {
  if (frame.empty()) {
    warn("no messages on " + topic + " yet: each frame waits 0.5 s for them");
  } else {
    warn("no transform on /tf_static or /tf from '" + frame + "' to '" +
         (is_camera() ? color_frame_ : cloud_frame_) + "' yet: until it comes, the sensor of " +
         topic + " is taken to be where the frames are");
  }
}

/// Whether the frame's mask and motion have arrived, or will not.
bool Ros2Source::is_complete(const Pending& pending) {
  const auto waited = Clock::now() - pending.since;
  find_mounting(pending.frame.stamp);
  if (!has_waited_) {
    if (!is_mounted() && waited < kMountingWait) return false;
    has_waited_ = true;
    if (!inputs_.wheels.empty() && !mounting_.T_sensor_base) {
      warn_of_mounting(inputs_.wheels, wheel_frame_);
    }
    if (!inputs_.imu.empty() && !mounting_.T_sensor_imu) {
      warn_of_mounting(inputs_.imu, imu_frame_);
    }
  }
  const Timestamp end = motion_end(pending.frame);
  const bool mask = inputs_.mask.empty() || !pending.color_stamp ||
                    (!masks_.empty() && masks_.back().first >= *pending.color_stamp);
  const bool wheels = inputs_.wheels.empty() || (!wheels_.empty() && wheels_.back().stamp > end);
  const bool imu = inputs_.imu.empty() || (!imu_.empty() && imu_.back().stamp > end);
  if (mask && wheels && imu) return true;
  if (waited < kMaxWait) return false;
  const std::scoped_lock lock(mutex_);
  ++counts_.incomplete;
  return true;
}

void Ros2Source::release(Pending pending) {
  complete(pending);
  {
    const std::scoped_lock lock(mutex_);
    sensor_frame_ = is_camera() ? color_frame_ : cloud_frame_;
    if (sensor_frame_.empty()) sensor_frame_ = "mms_sensor";  // tf2 refuses an empty frame_id
    ++counts_.frames;
  }
  push(std::move(pending.frame));
}

void Ros2Source::complete(Pending& pending) {
  Frame& frame = pending.frame;
  frame.calibration = calibration_of(frame);
  frame.expected_place = std::exchange(expected_place_, std::nullopt);
  // Masks have the stamps of the images they were made of, not those of clouds.
  while (pending.color_stamp && !masks_.empty() && masks_.front().first <= *pending.color_stamp) {
    auto& [stamp, mask] = masks_.front();
    const bool size = mask.width() == frame.color.width() && mask.height() == frame.color.height();
    if (stamp == *pending.color_stamp && size) frame.mask = std::move(mask);
    masks_.pop_front();
  }
  const Timestamp end = motion_end(frame);
  frame.motion.wheels = take_samples(wheels_, end);
  frame.motion.imu = take_samples(imu_, end);
}

std::shared_ptr<const Calibration> Ros2Source::calibration_of(const Frame& frame) {
  if (mounting_.empty()) return frame.calibration;
  if (received_ != frame.calibration) {
    Calibration calibration = *frame.calibration;
    calibration.motion = mounting_;
    received_ = frame.calibration;
    completed_ = std::make_shared<const Calibration>(std::move(calibration));
  }
  return completed_;
}

std::vector<std::string> Ros2Source::describe() const {
  const std::string topics = is_camera()             ? inputs_.color + ", " + inputs_.depth
                             : inputs_.color.empty() ? inputs_.points
                                                     : inputs_.points + ", " + inputs_.color;
  std::vector<std::string> lines = {"layout: topics of ROS 2"};
  if (is_camera()) {
    const CameraIntrinsics& camera = *calibration()->camera;
    lines.push_back("sensor: depth camera, " + std::to_string(camera.width) + "x" +
                    std::to_string(camera.height));
  } else {
    lines.push_back("sensor: LiDAR" + std::string(inputs_.color.empty() ? "" : " with a camera"));
  }
  lines.push_back("topics: " + topics);
  return lines;
}

void Ros2Source::count_damaged(const std::string& fault) {
  {
    const std::scoped_lock lock(mutex_);
    ++counts_.damaged;
  }
  // As with every image of a wrong encoding.
  constexpr auto kRepeat = std::chrono::seconds(5);
  constexpr std::size_t kMaxFaults = 100;
  const Clock::time_point now = Clock::now();
  const auto [last, is_new] = warned_.try_emplace(fault, now);
  if (!is_new && now - last->second < kRepeat) return;
  last->second = now;
  if (warned_.size() > kMaxFaults) warned_.clear();
  warn(fault);
}

std::string Ros2Source::report() {
  const auto now = Clock::now();
  const std::chrono::duration<double> passed = now - reported_;
  reported_ = now;
  std::string text = assembler_.report(passed.count());
  if (!is_camera()) return text;
  if (!depth_known_ && (depth_frame_.empty() || color_frame_.empty())) {
    text +=
        "; no frame_id of color or depth images, if they are registered give --depth-registered";
  } else if (!depth_known_) {
    if (!depth_camera_) text += "; camera_info of the depth images: none on " + inputs_.depth_info;
    if (!transforms_.lookup(color_frame_, depth_frame_, Timestamp())) {
      text += "; no transform from '" + depth_frame_ + "' to '" + color_frame_ +
              "', if they are registered give --depth-registered";
    }
  }
  return text;
}

Ros2InputCounts Ros2Source::counts() const {
  const std::scoped_lock lock(mutex_);
  Ros2InputCounts counts = counts_;
  counts.unmatched = assembler_.unmatched();
  counts.dropped = dropped();
  return counts;
}

std::string Ros2Source::sensor_frame() const {
  const std::scoped_lock lock(mutex_);
  return sensor_frame_;
}

}  // namespace mms
