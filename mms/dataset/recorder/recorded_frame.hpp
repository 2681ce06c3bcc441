#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mms/simulation/simulated_scene.hpp"

namespace mms {

// Conversion of simulated frames to recorded ones. Playing a scene and playing its recording give
// equal frames, because both use these functions.

/// Encodes the color image as JPEG.
/// @throws DataError if there is no image.
std::vector<std::uint8_t> recorded_color(const Frame& frame, const SensorPreset& sensor);

/// Depth in the recording's units, 0 for no return or beyond 16 bits.
Image<std::uint16_t> recorded_depth(const Image<float>& depth, double depth_scale);

/// The recorded label image: the exact one, or one with errors if the scene's mask_errors are
/// enabled.
Image<std::uint8_t> recorded_mask(const SimulatedFrame& frame, const SceneConfig& config);

/// File name of a frame without extension: the stamp in seconds for a depth camera, "000012" for a
/// LiDAR.
std::string recorded_name(const Frame& frame, const SensorPreset& sensor);

/// The recorded calibration: the scene's with the sensor's depth scale and maximum depth.
Calibration recorded_calibration(const Calibration& calibration, const SensorPreset& sensor);

/// The frame as read back from the recording.
Frame as_recorded(const SimulatedFrame& frame, const SceneConfig& config,
                  const SensorPreset& sensor);

}  // namespace mms
