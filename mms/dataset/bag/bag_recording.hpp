#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/dataset/source/source_options.hpp"
#include "mms/geometry/depth_registration.hpp"
#include "mms/ros/bag/bag_reader.hpp"

namespace mms {

/// One topic of a bag with the stamps of its messages.
struct BagStream {
  std::string topic;
  bool compressed = false;
  bool livox = false;  ///< scans of `is_livox_type`
  std::string frame_id;
  std::vector<Timestamp> stamps;
  Duration delay{0};  ///< of the recording after the stamp, median

  bool empty() const { return stamps.empty(); }
};

/// Message index of a frame in each stream, kNone if missing.
struct BagFrame {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  Timestamp stamp;
  std::size_t color = kNone;
  std::size_t depth = kNone;
  std::size_t cloud = kNone;
  std::size_t mask = kNone;
  std::filesystem::path mask_file{};  ///< replaces `mask`; empty for none
};

/// Content of a bag before images and clouds are read.
struct BagRecording {
  std::unique_ptr<BagReader> bag;
  BagStream color, depth, cloud, mask;  ///< no stamps if absent
  std::vector<BagFrame> frames;
  std::shared_ptr<const Calibration> calibration;  ///< of the frames
  std::optional<DepthRegistration> registration;   ///< of depth images that need it
  Trajectory ground_truth;
  MotionRecording motion;             ///< of wheels and gyroscope
  std::vector<std::string> facts;     ///< lines for `describe`
  std::vector<std::string> warnings;  ///< non-fatal faults
};

/// Selects the topics, reads all stamps and associates the frames, see bag_source.
/// @throws FileError, DataError, ConfigError as `open_bag`.
BagRecording read_bag_recording(const std::filesystem::path& path, const SourceOptions& options);

}  // namespace mms
