#pragma once

#include <memory>
#include <string>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/pipeline/config.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// What gives the masks of a recording's frames.
/// @param segmenter  "network", "masks" or "none"
/// @param data       the recording, for messages
/// @throws DataError when masks are wanted of a recording without; Error when there is no network.
std::unique_ptr<Segmenter> make_segmenter(const std::string& segmenter, const std::string& data,
                                          const SystemConfig& config, const FrameSource& source);

}  // namespace mms
