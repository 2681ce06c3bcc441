#pragma once

#include <filesystem>
#include <string>

#include "mms/dataset/source/bag_topic_names.hpp"

namespace mms {

/// Conversion of a recording.
struct RecordingConversion {
  std::string input;             ///< as of mms run
  std::filesystem::path output;  ///< x.bag, or else a folder
  BagTopicNames topics;          ///< of an input bag
  bool compressed = false;       ///< for an output bag
};

/// Whether a recording is to be converted: from a bag or a simulation, or to a bag.
bool is_recording_conversion(const std::string& input, const std::filesystem::path& output);

/// Writes the recording frame by frame, with masks and ground truth.
/// @throws Error if it cannot be read or written, or none of its frames can be read.
void convert_recording(const RecordingConversion& conversion);

}  // namespace mms
