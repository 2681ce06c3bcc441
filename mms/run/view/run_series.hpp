#pragma once

#include <vector>

#include "mms/server/scene/scene_data.hpp"

namespace mms {

/// The series of a run: milliseconds of reading and of all stages, share of dynamic points,
/// objects, distance to where the run began [cm], which is drift where the sensor stands still,
/// and, where there is truth, distance to it [cm].
std::vector<SeriesName> run_series(bool has_truth);

/// Adds a frame's distances to the values of the series before them. NaN where it has no truth.
void append_distances(std::vector<float>& values, const SceneFrame& frame, bool has_truth);

}  // namespace mms
