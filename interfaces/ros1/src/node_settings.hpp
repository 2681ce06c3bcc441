#pragma once

#include <ros/node_handle.h>

#include <string>

#include "interfaces/ros1/src/frame_assembler.hpp"
#include "mms/pipeline/config.hpp"

namespace mms {

/// Parameters of the node, below its name; docs/ros.md lists them.
struct NodeSettings {
  FrameAssembler::Sensor sensor = FrameAssembler::Sensor::kDepth;
  std::string masks = "network";  ///< "network", "remote" or "none"
  bool color_compressed = false;  ///< subscribe to .../compressed
  bool depth_compressed = false;  ///< subscribe to .../compressedDepth
  bool udp = false;               ///< masks by UDP
  int queue_size = 100;           ///< frames that may wait
  double mask_wait = 3.0;         ///< of a frame for masks from another host [s]
  double link_timeout = 4.0;      ///< without masks until the link counts as lost [s]
  int remote_width = 384;         ///< of images sent to another host, at most [px]
  int remote_quality = 80;        ///< of their JPEG
  double map_period = 2.0;        ///< between two maps [s]
  bool publish_tf = true;
  std::string map_frame = "map";          ///< z up, x forward
  std::string world_frame = "mms_world";  ///< the first sensor frame
  int threads = 0;                        ///< 0: one a core
  std::string results = ".";              ///< where save_map writes
  SystemConfig system;                    ///< the file of ~config and what ~settings overrides

  /// @throws ConfigError, DataError, FileError naming the parameter and what is allowed.
  static NodeSettings load(const ros::NodeHandle& node);
};

/// What ~config and ~settings say of the system, also for the segmentation node.
SystemConfig load_system_config(const ros::NodeHandle& node);

}  // namespace mms
