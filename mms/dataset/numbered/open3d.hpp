#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names is a recording in the layout of Open3D.
bool is_open3d_layout(const std::vector<std::string>& names);

/// Opens a recording in the layout of Open3D's reconstruction system, its recorders for RealSense
/// and Azure Kinect, and the Redwood data sets: numbered images in color/, image/ or rgb/ and in
/// depth/ [mm], or folders of similar names, the camera in camera_intrinsic.json, intrinsic.json or
/// calibration.yaml, optional poses in trajectory.log. Without a camera file, images of 640x480 are
/// taken for those of a PrimeSense camera, as in Redwood.
/// @throws FileError, DataError; ConfigError for an invalid calibration.yaml.
std::unique_ptr<FrameSource> open_open3d(const std::filesystem::path& folder,
                                         const SourceOptions& options);

}  // namespace mms
