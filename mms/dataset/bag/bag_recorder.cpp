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
constexpr const char* kColorTopic = "/camera/color/image_raw";
constexpr const char* kInfoTopic = "/camera/color/camera_info";
constexpr const char* kDepthTopic = "/camera/aligned_depth_to_color/image_raw";
constexpr const char* kMaskTopic = "/camera/mask/image_raw";
constexpr const char* kCloudTopic = "/points";
constexpr const char* kTruthTopic = "/ground_truth";
constexpr double kMillimetres = 1000.0;  // units per meter
constexpr int kJpegQuality = 95;

class BagRecorder final : public FrameRecorder {
 public:
  BagRecorder(const std::filesystem::path& path, bool compressed)
      : bag_(create_bag(path)), compressed_(compressed) {}

  void add(const Frame& frame) override {
    if (count_ == 0) add_extrinsics(frame);
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
    msg::TransformStamped transform;
    transform.header = header_of(frame.stamp, kCameraFrame);
    transform.child_frame_id = kLidarFrame;
    transform.transform = pose_message(frame.calibration->T_camera_lidar.isometry());
    bag_->write("/tf_static", frame.stamp, msg::Transforms{{transform}});
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
