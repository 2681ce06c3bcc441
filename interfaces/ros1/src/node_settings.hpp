#pragma once

#include <ros/node_handle.h>

#include <string>

#include "mms/dataset/live/frame_assembler.hpp"
#include "mms/pipeline/system_config.hpp"

namespace mms {

/// Private parameters of the node, see docs/ros.md.
struct NodeSettings {
  FrameAssembler::Sensor sensor = FrameAssembler::Sensor::kDepth;
  std::string masks = "network";  ///< "network", "remote" or "none"
  bool color_compressed = false;  ///< subscribe to .../compressed
  bool depth_compressed = false;  ///< subscribe to .../compressedDepth
  bool udp = false;               ///< masks by UDP
  int queue_size = 100;           ///< frames that may wait
  double mask_wait = 3.0;         ///< waiting time of a frame for masks from another host [s]
  double link_timeout = 4.0;      ///< time without masks until the link counts as lost [s]
  int remote_width = 384;         ///< largest width of images sent to another host [px]
  int remote_quality = 80;        ///< of their JPEG
  double map_period = 2.0;        ///< between two maps [s]
  bool publish_tf = true;
  std::string map_frame = "map";          ///< z up, x forward
  std::string world_frame = "mms_world";  ///< the first sensor frame
  int threads = 0;                        ///< 0: one per core
  std::string results = ".";              ///< output folder of save_map
  SystemConfig system;                    ///< from the file ~config, overridden by ~settings

  /// @throws ConfigError, DataError, FileError with the parameter and the allowed values.
  static NodeSettings load(const ros::NodeHandle& node);
};

/// Settings of the system from ~config and ~settings, also for the segmentation node.
SystemConfig load_system_config(const ros::NodeHandle& node);

}  // namespace mms
