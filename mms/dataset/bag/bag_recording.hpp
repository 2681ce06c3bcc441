#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/dataset/source/source_options.hpp"
#include "mms/ros/bag_reader.hpp"

namespace mms {

/// One topic of a bag, with the stamps of all its messages.
struct BagStream {
  std::string topic;
  bool compressed = false;
  std::string frame_id;
  std::vector<Timestamp> stamps;

  bool empty() const { return stamps.empty(); }
};

/// A frame's message in each stream, by its index, kNone where it has none.
struct BagFrame {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  Timestamp stamp;
  std::size_t color = kNone;
  std::size_t depth = kNone;
  std::size_t cloud = kNone;
  std::size_t mask = kNone;
  std::filesystem::path mask_file{};  ///< in place of `mask`; empty for none
};

/// All that is known of a bag before its images and clouds are read.
struct BagRecording {
  std::unique_ptr<BagReader> bag;
  BagStream color, depth, cloud, mask;  ///< without stamps where there are none
  std::vector<BagFrame> frames;
  std::shared_ptr<const Calibration> calibration;
  Trajectory ground_truth;
  std::vector<std::string> facts;     ///< lines for `describe`
  std::vector<std::string> warnings;  ///< what was wrong but can be lived with
};

/// Chooses the topics, reads all stamps and puts the frames together, as bag_source says.
/// @throws FileError, DataError, ConfigError as `open_bag` does.
BagRecording read_bag_recording(const std::filesystem::path& path, const SourceOptions& options);

}  // namespace mms
