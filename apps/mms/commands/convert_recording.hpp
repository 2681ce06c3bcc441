#pragma once

#include <filesystem>
#include <string>

#include "mms/dataset/source/bag_topic_names.hpp"

namespace mms {

/// A recording to be written in another form.
struct RecordingConversion {
  std::string input;             ///< as of mms run
  std::filesystem::path output;  ///< x.bag, or else a folder
  BagTopicNames topics;          ///< of a bag that is read
  bool compressed = false;       ///< of a bag that is written
};

/// Whether that is what is asked for: from a bag or a simulation, or into a bag.
bool is_recording_conversion(const std::string& input, const std::filesystem::path& output);

/// Writes the recording frame by frame, with its masks and truth.
/// @throws Error when it cannot be read or written, or none of its frames can be read.
void convert_recording(const RecordingConversion& conversion);

}  // namespace mms
