#pragma once

#include <filesystem>
#include <memory>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Opens a capture of the packets of a Velodyne or an Ouster sensor. A rotation is a frame; points
/// have times. The stamp of the first rotation is the time of capture, or the sensor's if it counts
/// from 1970; later ones follow by the sensor's clock. Beside NAME.pcap: the metadata of an Ouster
/// in NAME.json, or the only .json there; the corrections of an HDL-64E in NAME.yaml; ground truth
/// in NAME.groundtruth.txt (TUM).
/// @throws FileError, DataError with the packets found if there are none of these sensors;
/// ConfigError for invalid corrections.
std::unique_ptr<FrameSource> open_capture(const std::filesystem::path& path,
                                          const SourceOptions& options);

}  // namespace mms
