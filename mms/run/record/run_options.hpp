#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mms/dataset/source/bag_topic_names.hpp"
#include "mms/dataset/source/camera_options.hpp"
#include "mms/dataset/source/motion_files.hpp"

namespace mms {

/// Address of the viewer.
struct ViewOptions {
  std::uint16_t port = 8080;
  std::string bind = "127.0.0.1";
};

/// Arguments of `mms run`.
struct RunOptions {
  std::string data = "sim:warehouse_loop";
  std::filesystem::path config;    ///< empty: the defaults
  std::vector<std::string> set;    ///< settings "group.key=value", after those of `config`
  std::filesystem::path output;    ///< empty: `results/TIME_NAME`
  bool overwrite = false;          ///< replace the results of an earlier run in `output`
  std::string segmenter;           ///< "network", "masks" or "none"
  std::filesystem::path masks;     ///< empty: the recording's own
  std::string weights;             ///< of the network; empty: as the config says
  BagTopicNames topics;            ///< of a bag
  CameraOptions camera;            ///< in place of the recording's
  std::optional<double> rate;      ///< [Hz] of a recording without time stamps; unset: assumed
  MotionOptions motion;            ///< wheels and gyroscope
  std::string fusion;              ///< empty: as the config says
  std::string loops;               ///< "on", "off"; empty: as the config says
  std::filesystem::path map;       ///< earlier map to start from; empty: none
  std::filesystem::path save_map;  ///< where the map is written; empty: in `map`, if any
  bool localize = false;           ///< changes no map
  std::size_t frames = std::numeric_limits<std::size_t>::max();
  std::size_t start = 0;
  bool map_truth = true;  ///< false: map and objects are not compared with the ground truth
  bool realtime = false;
  bool keep_journal = false;
  bool mcap = false;  ///< records the results for viewers of ROS 2
  int threads = 0;    ///< 0: one per core
  std::optional<ViewOptions> view;
};

}  // namespace mms
