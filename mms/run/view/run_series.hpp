#pragma once

#include <vector>

#include "mms/server/scene/scene_data.hpp"

namespace mms {

/// The series of a run: milliseconds of reading, of all stages, and since the end of the previous
/// frame (less than their sum, as stages overlap), dynamic and overruled share, objects, distance
/// from the start [cm], which is drift for a static sensor, and distance from the ground truth [cm]
/// if available.
std::vector<SeriesName> run_series(bool has_truth);

/// Appends a frame's distances to its other values. NaN without ground truth.
void append_distances(std::vector<float>& values, const SceneFrame& frame, bool has_truth);

}  // namespace mms
