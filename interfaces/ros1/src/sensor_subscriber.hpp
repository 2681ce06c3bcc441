#pragma once

#include <ros/ros.h>

#include <functional>
#include <mutex>
#include <string>

#include "interfaces/ros1/src/frame_assembler.hpp"
#include "interfaces/ros1/src/node_settings.hpp"
#include "mms/ros/display_messages.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {

/// Subscribes to the sensor's topics and hands out the frames that come of them, one at a time.
class SensorSubscriber {
 public:
  using Sink = std::function<void(Frame)>;

  SensorSubscriber(ros::NodeHandle& node, const NodeSettings& settings, Sink sink);

  /// frame_id of the images or clouds that frames are localised by. For the sink.
  const std::string& frame_id() const { return frame_id_; }

  /// What arrived since the last call, and what is missing, with the topics' names.
  std::string report(double seconds);

  std::size_t unmatched();  ///< images that went without their counterpart
  std::size_t damaged();    ///< messages that could not be read

 private:
  void subscribe_color(ros::NodeHandle& node);
  void subscribe_depth(ros::NodeHandle& node);
  void subscribe_cloud(ros::NodeHandle& node);
  void find_extrinsics();

  /// Runs `add`, which a damaged message may make fail, and hands out the frames it completed.
  template <class Add>
  void take(const Add& add);

  NodeSettings settings_;
  Sink sink_;
  std::mutex mutex_;  ///< of all below: callbacks of several topics run at once
  FrameAssembler assembler_;
  TransformTree transforms_;
  std::string frame_id_;
  std::string color_frame_;
  std::size_t damaged_ = 0;
  std::string topics_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace mms
