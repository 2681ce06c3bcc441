#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "mms/core/frame.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms::testing {

/// A corridor with a person walking ahead: 320 x 240 pixels, quick to render.
SceneConfig small_scene(int frames);

/// "0003" of frame 3, the name of its images without extension.
std::string frame_name(int index);

/// Writes a simulated scene as a TUM-layout sequence with masks, truth and calibration: frame i has
/// the stamp 100 + i / hz.
void write_scene(const std::filesystem::path& folder, const SceneConfig& config);

/// A spinning LiDAR's scan of an empty hall, at `x` metres from its center.
LidarScan hall_scan(double x);

/// Writes scans of a sensor that moves 5 cm per frame as a KITTI folder of 000000.bin, ...
void write_hall(const std::filesystem::path& folder, int frames);
void write_scan(const std::filesystem::path& file, const LidarScan& scan);

/// The parsed file; null and a failure of the test if it is not JSON.
nlohmann::json json_file(const std::filesystem::path& path);

std::set<std::string> keys_of(const nlohmann::json& object);

/// The --segmenter for the masks of a recording: "masks", or "none" if it has none.
std::string segmenter_of(const std::filesystem::path& data);

}  // namespace mms::testing
