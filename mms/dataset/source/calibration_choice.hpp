#pragma once

#include <functional>
#include <optional>

#include "mms/dataset/source/camera_options.hpp"
#include "mms/dataset/source/rgbd_source.hpp"

namespace mms {

/// Sets the calibration of a recording and adds facts: the file of the options, else
/// calibration.yaml of its folder, else that of its layout. Then intrinsics and depth scale of the
/// options replace those; the image size is that of the depth images.
/// @param of_layout  nullopt: the layout has none. Not called where a file is used; adds its own
///                   facts
/// @throws DataError if there is no camera; FileError, ConfigError for an invalid file.
void choose_calibration(RgbdRecording& recording, const CameraOptions& options,
                        const std::function<std::optional<Calibration>()>& of_layout);

/// Depth images of ARKit (256x192, iPhone and iPad with LiDAR) are registered to larger color
/// images: colors are sampled for them then. The calibration may be that of either size.
void sample_colors_of_arkit(RgbdRecording& recording);

/// For recordings that take a calibration file alone.
/// @throws DataError with `recording` if intrinsics or depth scale are given.
void reject_image_options(const std::filesystem::path& recording, const CameraOptions& options);

}  // namespace mms
