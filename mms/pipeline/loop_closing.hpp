#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "mms/core/thread_confinement.hpp"
#include "mms/global_map/global_map.hpp"
#include "mms/pipeline/correction_feed.hpp"
#include "mms/pipeline/system_config.hpp"

namespace mms {

/// The stage beside the maps that corrects the drift of the odometry. Owns the global map. No other
/// stage depends on it.
class LoopClosing {
 public:
  explicit LoopClosing(const SystemConfig& config);

  /// Adds a keyframe to the global map. One thread at a time, keyframes in order; the global map
  /// may be read in that thread.
  /// @returns the correction since
  MapCorrection close_loops(const GlobalKeyframe& keyframe);

  /// Recognizes the place of a lost frame, see `GlobalMap`. In the same thread.
  std::optional<Relocalization> relocalize(const GlobalKeyframe& frame);

  /// Takes an earlier map before the first keyframe, see `GlobalMap`.
  void restore(GlobalMapContent content, MapUse use) {
    global_map_.restore(std::move(content), use);
  }

  /// Brings the global map up to date after the last keyframe.
  void finish();

  const GlobalMap& global_map() const;

  void release_thread() { thread_.release(); }  ///< lets another thread call

 private:
  GlobalMap global_map_;
  std::shared_ptr<const std::vector<SessionPlace>> places_;  // at the last loop
  std::shared_ptr<const std::vector<ClosedLoop>> loops_;
  ThreadConfinement thread_;
};

}  // namespace mms
