#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "mms/pipeline/async_pipeline.hpp"
#include "mms/ros/display_messages.hpp"
#include "mms/ros/growing_path.hpp"
#include "mms/ros/robot_frame.hpp"
#include "mms/ros2/ros2_node.hpp"
#include "mms/ros2/ros2_source.hpp"

namespace mms {

/// How results are published.
struct Ros2ResultOptions {
  bool transforms = true;  ///< on `transforms_topic`
  std::string transforms_topic = "/tf";
  std::string map_frame = "map";          ///< of the global map: z up, x forward
  std::string world_frame = "mms_world";  ///< of the odometry: the first sensor frame
  double map_period = 2.0;                ///< between two maps [s]
};

/// Publishes the results of a run below "~/", and on /tf and /diagnostics. Messages
/// without subscribers are not created.
class Ros2Results {
 public:
  /// @param node  outlives this
  Ros2Results(Ros2Node& node, const Ros2ResultOptions& options);

  /// Publishes a frame; called in one thread.
  /// @param is_camera  whether the sensor frame has the axes of a camera
  void publish(const Processed& processed, const SlamSystem& system,
               const std::string& sensor_frame, bool is_camera);

  /// Publishes the diagnostics since the last call; in any thread.
  /// @param inputs  rates of the topics, and what is missing
  void diagnose(const std::string& inputs, const Ros2InputCounts& counts);

 private:
  using Clock = std::chrono::steady_clock;

  void publish_path(const msg::Header& world, const OdometryEstimate& odometry);
  void publish_clouds(const msg::Header& sensor, const LabeledCloud& cloud);

  Ros2ResultOptions options_;
  std::string node_name_;
  RobotFrame robot_;
  Ros2Writer odometry_, transforms_, path_topic_, static_cloud_, dynamic_cloud_, map_, markers_,
      objects_, mask_, diagnostics_;
  GrowingPath path_;
  Clock::time_point last_map_, last_path_;

  std::mutex mutex_;                          ///< guards all below
  std::optional<msg::DiagnosticArray> last_;  ///< of the last frame
  std::size_t frames_ = 0;
  std::size_t reported_ = 0;  ///< of these, at the last diagnosis
  Clock::time_point diagnosed_ = Clock::now();
};

}  // namespace mms
