#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "mms/dataset/live/frame_assembler.hpp"
#include "mms/dataset/live/live_source.hpp"
#include "mms/ros/transform_tree.hpp"
#include "mms/ros2/ros2_node.hpp"

namespace mms {

/// Topics of the sensor, as given on the command line; an empty name: none. Names that end with
/// "/compressed" or "/compressedDepth" are of the type CompressedImage.
struct Ros2Inputs {
  std::string color{};
  std::string depth{};        ///< without `points`
  std::string depth_info{};   ///< CameraInfo of depth images with a frame of their own, which are
                              ///< registered then; empty: they are registered already
  std::string camera_info{};  ///< of the color images
  std::string points{};       ///< LiDAR scans, with or without color images
  std::string imu{};
  std::string wheels{};  ///< nav_msgs/Odometry
  std::string mask{};    ///< label images: 0 static, 1 person, 2 vehicle
  std::string initial_pose =
      "/initialpose";  ///< PoseWithCovarianceStamped: where a user says that the sensor is
  std::string transforms = "/tf";  ///< static ones come on the same name with _static
  std::string map_frame = "map";   ///< frame of the initial pose: x forward, z up
};

/// Counts since the start.
struct Ros2InputCounts {
  std::size_t frames = 0;      ///< complete ones
  std::size_t unmatched = 0;   ///< images without counterpart
  std::size_t damaged = 0;     ///< messages that could not be read
  std::size_t not_later = 0;   ///< frames whose stamps did not increase
  std::size_t incomplete = 0;  ///< frames that went on without mask or motion
  std::size_t dropped = 0;     ///< frames that found no room
};

/// The sensor of the topics of a node as a source of frames, which are assembled by the rules for
/// recordings. Its end stops the node.
class Ros2Source final : public LiveSource {
 public:
  /// Subscribes to the topics.
  /// @param queue  frames that may wait
  /// @param stop   whether the source should end; called in the node's thread
  /// @param on_clock_back  called there where the clock of the stamps went back
  Ros2Source(Ros2Node& node, const Ros2Inputs& inputs, std::size_t queue,
             std::function<bool()> stop, std::function<void()> on_clock_back);
  ~Ros2Source() override { node_.stop(); }

  bool has_masks() const override { return !inputs_.mask.empty(); }
  std::vector<std::string> describe() const override;

  /// Counts a message that could not be read, and warns.
  void count_damaged(const std::string& fault);

  // In the node's thread:

  /// Rates of the inputs since the last call, and what is missing.
  std::string report();
  Ros2InputCounts counts() const;

  /// frame_id of the images or clouds that are localized.
  std::string sensor_frame() const;
  bool is_camera() const { return inputs_.points.empty(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Pending {
    Frame frame;
    std::optional<Timestamp> color_stamp;  ///< of its color image, as for its mask
    Clock::time_point since;
  };

  void subscribe_color();
  void subscribe_depth();
  void subscribe_points();
  void subscribe_motion();
  void subscribe_transforms();
  void subscribe_initial_pose();
  void advance();
  void take_frames();
  bool find_extrinsics();
  bool find_depth_camera();
  bool is_mounted() const {
    return (inputs_.wheels.empty() || mounting_.T_sensor_base) &&
           (inputs_.imu.empty() || mounting_.T_sensor_imu);
  }
  void find_mounting(Timestamp stamp);
  void warn_of_mounting(const std::string& topic, const std::string& frame);
  bool is_placed() const;
  bool is_complete(const Pending& pending);
  void release(Pending pending);
  void complete(Pending& pending);
  std::shared_ptr<const Calibration> calibration_of(const Frame& frame);

  Ros2Node& node_;
  Ros2Inputs inputs_;
  std::function<bool()> stop_;
  std::function<void()> on_clock_back_;

  // Of the node's thread:
  FrameAssembler assembler_;
  TransformTree transforms_{
      1000};  ///< so many of each frame: those of a robot would fill the memory
  std::string color_frame_, depth_frame_, cloud_frame_, wheel_frame_, imu_frame_;
  std::optional<CameraIntrinsics> depth_camera_;  ///< as received
  bool depth_known_ = false;     ///< how to register depth images, or that they are
  std::deque<Pending> pending_;  ///< frames that wait for masks or motion
  std::deque<std::pair<Timestamp, Image<std::uint8_t>>> masks_;
  std::deque<WheelSample> wheels_;
  std::deque<ImuSample> imu_;
  std::optional<Transform<Global, Sensor>> expected_place_;  ///< for the next frame
  std::optional<Timestamp> last_stamp_;
  std::shared_ptr<const Calibration> received_;   ///< that of the last frame
  std::shared_ptr<const Calibration> completed_;  ///< the same with the mounting of the motion
  MotionCalibration mounting_;                    ///< as far as it is known
  bool has_waited_ = false;                       ///< the first frame, for the mounting
  Clock::time_point reported_ = Clock::now();
  std::map<std::string, Clock::time_point>
      warned_;  ///< faults of messages, and when they were warned of

  mutable std::mutex mutex_;  ///< guards all below
  std::string sensor_frame_;
  Ros2InputCounts counts_;
};

}  // namespace mms
