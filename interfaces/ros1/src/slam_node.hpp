#pragma once

#include <ros/ros.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "interfaces/ros1/src/mask_exchange.hpp"
#include "interfaces/ros1/src/result_publisher.hpp"
#include "interfaces/ros1/src/ros_traits.hpp"
#include "interfaces/ros1/src/sensor_subscriber.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/dataset/live/frame_queue.hpp"

namespace mms {

/// The SLAM system as a node: frames of the subscribers pass through an AsyncPipeline in a thread,
/// which publishes the results.
class SlamNode {
 public:
  explicit SlamNode(const NodeSettings& settings);
  ~SlamNode();
  SlamNode(const SlamNode&) = delete;
  SlamNode& operator=(const SlamNode&) = delete;

 private:
  using Task = std::function<void(const SlamSystem&)>;

  void take(Frame frame);
  void send_to_segmentation(const Frame& frame);
  void receive_masks(const msg::Masks& masks);
  std::unique_ptr<Segmenter> make_segmenter();
  void run_pipeline();
  std::optional<Frame> next_frame();
  void finish_frame(const Processed& processed, const SlamSystem& system);
  bool between_frames(const Task& task);
  bool save_map(TriggerRequest&, TriggerResponse& response);
  bool reset(TriggerRequest&, TriggerResponse& response);
  void diagnose();

  NodeSettings settings_;
  ros::NodeHandle node_{"~"};
  ros::NodeHandle public_node_;
  ResultPublisher results_;
  FrameQueue queue_;
  MaskExchange exchange_;
  std::unique_ptr<SensorSubscriber> sensor_;
  ros::Publisher diagnostics_, remote_images_;
  ros::Subscriber remote_masks_;
  ros::ServiceServer save_map_, reset_;
  ros::WallTimer timer_;

  std::optional<Timestamp> last_stamp_;  ///< of `take`, whose callers wait for each other

  std::mutex mutex_;  ///< guards all below
  std::condition_variable changed_;
  int in_flight_ = 0;  ///< frames between queue and result
  bool paused_ = false;
  bool resetting_ = false;
  const SlamSystem* system_ = nullptr;
  Trajectory trajectory_, keyframes_;
  std::size_t processed_ = 0;
  std::size_t reported_ = 0;  ///< of these, at the last diagnosis
  std::size_t lost_ = 0;
  double frame_ms_ = 0.0;
  bool link_was_lost_ = false;
  std::string sensor_frame_;
  int image_width_ = 0;
  int image_height_ = 0;

  std::atomic<bool> closing_ = false;
  std::thread pipeline_;
};

}  // namespace mms
