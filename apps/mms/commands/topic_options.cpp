#include "apps/mms/commands/topic_options.hpp"

namespace mms {

void add_topic_options(CLI::App& command, BagTopicNames& topics) {
  const auto add = [&](const char* name, std::string& topic, const char* help) {
    command.add_option(name, topic, help)->group("Topics of a bag (default: by type and name)");
  };
  add("--topic-color", topics.color, "color images, Image or CompressedImage");
  add("--topic-depth", topics.depth, "depth images registered to them");
  add("--topic-cloud", topics.cloud, "LiDAR scans, PointCloud2 or CustomMsg of Livox");
  add("--topic-camera-info", topics.camera_info, "CameraInfo of the color images");
  add("--topic-mask", topics.mask, "label images: 0 static, 1 person, 2 vehicle");
  add("--topic-wheels", topics.wheels, "wheel odometry, Odometry");
  add("--topic-imu", topics.imu, "gyroscope, Imu");
  add("--topic-truth", topics.truth,
      "ground-truth poses: PoseStamped, TransformStamped, Odometry or tf");
}

void add_motion_options(CLI::App& command, MotionOptions& options) {
  const auto add = [&](const char* name, std::filesystem::path& file, const char* help) {
    command.add_option(name, file, help)
        ->check(CLI::ExistingFile | CLI::IsMember({"none"}))
        ->group("Motion sensors (default: the recording's)");
  };
  add("--wheels", options.wheels,
      "wheel odometry, a TUM trajectory or odometry.csv; none: not used");
  add("--imu", options.imu, "rates of a gyroscope, as EuRoC's imu0/data.csv; none: not used");
}

}  // namespace mms
