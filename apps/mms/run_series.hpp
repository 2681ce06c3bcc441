#pragma once

#include <vector>

#include "mms/server/scene_data.hpp"

namespace mms {

/// The series of a run: milliseconds of reading and of all stages, share of dynamic points,
/// objects, and `error_or_drift`.
std::vector<SeriesName> run_series(bool has_truth);

/// Distance to the true position; where a run has no truth, to where it began, which is drift where
/// the sensor stands still [cm]. NaN for a frame of a run with truth that has none.
float error_or_drift(const SceneFrame& frame, bool has_truth);

}  // namespace mms
