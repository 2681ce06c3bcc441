#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names is a scene of Replica as NICE-SLAM renders it.
bool is_replica_layout(const std::vector<std::string>& names);

/// Opens a scene of Replica as NICE-SLAM renders it: results/frameN.jpg, results/depthN.png,
/// traj.txt (one 4x4 matrix a line, camera-to-world, of frames 0, 1, ...). The camera is that of
/// cam_params.json in the folder or in its parent, else NICE-SLAM's (1200x680, 600 px).
/// @throws FileError, DataError.
std::unique_ptr<FrameSource> open_replica(const std::filesystem::path& folder,
                                          const SourceOptions& options);

}  // namespace mms
