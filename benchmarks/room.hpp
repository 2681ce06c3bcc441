#pragma once

#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/trajectory.hpp"

namespace mms {

/// Fixed input of the benchmarks: the first seconds of the simulated room, rendered once.
struct RoomRecording {
  std::vector<Frame> frames;
  Trajectory truth;
};

const RoomRecording& room_recording();

}  // namespace mms
