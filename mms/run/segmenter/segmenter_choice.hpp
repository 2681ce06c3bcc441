#pragma once

#include <memory>
#include <string>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// The source of masks for a recording's frames.
/// @param segmenter  "network", "masks" or "none"
/// @param data       the recording, for messages
/// @throws DataError if the recording has no masks; Error if there is no network.
std::unique_ptr<Segmenter> make_segmenter(const std::string& segmenter, const std::string& data,
                                          const SystemConfig& config, const FrameSource& source);

}  // namespace mms
