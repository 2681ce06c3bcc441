#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "mms/core/object_box.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/io/journal/disk_log.hpp"
#include "mms/pipeline/frame_result.hpp"

namespace mms {

/// Data kept of every frame of a run.
struct LoggedFrame {
  Timestamp stamp;
  std::int64_t index = 0;     ///< in the recording
  std::uint32_t session = 0;  ///< of the run, see `FrameResult`
  Transform<World, Sensor> T_world_sensor;
  Status status = Status::kInitialized;
  bool keyframe = false;
  bool relocalized = false;
  bool is_searching = false;  ///< lost, and its place is searched for
  bool in_map = false;        ///< whether its place in the map was known then
  double dynamic_share = 0.0;
  double overruled_share = 0.0;
  int implausible_masks = 0;
  double read_ms = 0.0;
  double interval_ms = 0.0;  ///< wall time since the end of the previous frame
  StageTimes stage_ms{};
  std::optional<double> latency_ms;  ///< of live sensors and in real-time mode

  double stages_ms() const;  ///< sum of reading and all stages
};

/// For `DiskLog`.
template <class Visitor>
void visit_fields(Visitor& v, LoggedFrame& frame) {
  v(frame.stamp);
  v(frame.index);
  v(frame.session);
  visit_fields(v, frame.T_world_sensor);
  v(frame.status);
  for (bool* flag : {&frame.keyframe, &frame.relocalized, &frame.is_searching, &frame.in_map}) {
    v(*flag);
  }
  v(frame.dynamic_share);
  v(frame.overruled_share);
  v(frame.implausible_masks);
  v(frame.read_ms);
  v(frame.interval_ms);
  for (double& ms : frame.stage_ms) v(ms);
  bool has_latency = frame.latency_ms.has_value();
  double latency_ms = frame.latency_ms.value_or(0.0);
  v(has_latency);
  v(latency_ms);
  if (has_latency) frame.latency_ms = latency_ms;
}

}  // namespace mms
