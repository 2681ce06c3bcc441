#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mms/simulation/simulated_scene.hpp"

namespace mms {

// What a recording keeps of a simulated frame. Playing a scene gives the same frames as playing its
// recording, as both go through here.

/// The bytes of the colour image's JPEG file. @throws DataError when there is no image.
std::vector<std::uint8_t> recorded_color(const Frame& frame, const SensorPreset& sensor);

/// Depth in the recording's units, 0 where there is no return or too far for 16 bits.
Image<std::uint16_t> recorded_depth(const Image<float>& depth, double depth_scale);

/// The label image that is given along: the exact one, or one as a network would give it when the
/// scene's mask_errors are enabled.
Image<std::uint8_t> recorded_mask(const SimulatedFrame& frame, const SceneConfig& config);

/// What the frame's files are called, without their endings: the stamp in seconds for a depth
/// camera, "000012" for a LiDAR.
std::string recorded_name(const Frame& frame, const SensorPreset& sensor);

/// The calibration written beside the frames: the scene's with the sensor's units and reach of
/// depth.
Calibration recorded_calibration(const Calibration& calibration, const SensorPreset& sensor);

/// The frame that comes back from the recording.
Frame as_recorded(const SimulatedFrame& frame, const SceneConfig& config,
                  const SensorPreset& sensor);

}  // namespace mms
