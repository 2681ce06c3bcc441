#pragma once

#include <filesystem>
#include <memory>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a file is a recording of OpenNI, by its name: x.oni.
bool is_oni_name(const std::filesystem::path& path);

/// Opens a recording of OpenNI: frames are color images with the depth image of the same time,
/// which is taken as registered. Read forward only.
/// @throws DataError as `open_oni` and `camera_calibration`, and for masks.
std::unique_ptr<FrameSource> open_oni_recording(const std::filesystem::path& path,
                                                const SourceOptions& options);

}  // namespace mms
