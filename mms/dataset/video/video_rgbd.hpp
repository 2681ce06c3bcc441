#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Whether a folder with these file names has a video and depth images.
bool is_video_rgbd_layout(const std::vector<std::string>& names);

/// Opens a color video with a folder depth/, as of Stray Scanner. The stamps are the times of
/// presentation in the video. A depth image belongs to the image of the video with its number, or,
/// if the names are stamps, to that within 0.02 s; then the video begins at the first depth image.
/// The camera is that of calibration.yaml or of camera_matrix.csv (3x3, for images of the video),
/// scaled to the size of the depth images; colors are sampled for them. Optional are masks/, named
/// as the depth images, and poses in groundtruth.txt (TUM) or odometry.csv of Stray Scanner.
/// @throws FileError, DataError; ConfigError for an invalid calibration.yaml.
std::unique_ptr<FrameSource> open_video_rgbd(const std::filesystem::path& folder,
                                             const SourceOptions& options);

}  // namespace mms
