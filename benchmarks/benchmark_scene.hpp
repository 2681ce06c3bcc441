#pragma once

#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/trajectory.hpp"

namespace mms {

/// Fixed input of the benchmarks: the first seconds of the simulated warehouse, rendered once.
struct SceneRecording {
  std::vector<Frame> frames;
  Trajectory truth;
};

const SceneRecording& scene_recording();

}  // namespace mms
