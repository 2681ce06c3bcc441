#pragma once

#include <ros/ros.h>

#include <functional>
#include <mutex>
#include <string>

#include "interfaces/ros1/src/node_settings.hpp"
#include "mms/dataset/live/frame_assembler.hpp"
#include "mms/ros/display_messages.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {

/// Subscribes to the sensor's topics and passes on complete frames, one at a time.
class SensorSubscriber {
 public:
  using Sink = std::function<void(Frame)>;

  SensorSubscriber(ros::NodeHandle& node, const NodeSettings& settings, Sink sink);

  /// frame_id of the images or clouds that are localized. To be called by the sink.
  const std::string& frame_id() const { return frame_id_; }

  /// Statistics since the last call, and what is missing, with topic names.
  std::string report(double seconds);

  std::size_t unmatched();  ///< images without counterpart
  std::size_t damaged();    ///< unreadable messages

 private:
  void subscribe_color(ros::NodeHandle& node);
  void subscribe_depth(ros::NodeHandle& node);
  void subscribe_cloud(ros::NodeHandle& node);
  void find_extrinsics();

  /// Runs `add`, which may throw for a damaged message, and passes on the completed frames.
  template <class Add>
  void take(const Add& add);

  NodeSettings settings_;
  Sink sink_;
  std::mutex mutex_;  ///< guards all below: topics have concurrent callbacks
  FrameAssembler assembler_;
  TransformTree transforms_{
      1000};  ///< so many of each frame: those of a robot would fill the memory
  std::string frame_id_;
  std::string color_frame_;
  std::size_t damaged_ = 0;
  std::string topics_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace mms
