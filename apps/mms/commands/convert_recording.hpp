#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mms/dataset/source/bag_topic_names.hpp"
#include "mms/dataset/source/camera_options.hpp"

namespace mms {

/// Conversion of a recording.
struct RecordingConversion {
  std::string input;             ///< as for mms run
  std::filesystem::path output;  ///< x.bag, x.mcap, or else a folder
  BagTopicNames topics;          ///< of an input bag
  CameraOptions camera;          ///< in place of the recording's
  std::optional<double> rate;    ///< [Hz] of a recording without time stamps; unset: assumed
  bool compressed = false;       ///< for an output bag
  bool overwrite = false;        ///< replaces an output bag
};

/// Whether a recording is to be converted: from a bag, a folder of rosbag2, a capture or a
/// simulation, or to a bag.
bool is_recording_conversion(const std::string& input, const std::filesystem::path& output);

/// Writes the recording frame by frame, with masks and ground truth. The output of a conversion
/// that was interrupted has ".partial" in its name.
/// @throws Error if it cannot be read or written, or none of its frames can be read; FileError if
/// the output exists, unless `overwrite` for a bag.
void convert_recording(const RecordingConversion& conversion);

}  // namespace mms
