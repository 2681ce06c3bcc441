#include "mms/pipeline/loop_closing.hpp"

#include <cassert>

namespace mms {
namespace {

/// The accepted loops within the run.
std::vector<ClosedLoop> closed_loops(const GlobalMap& map) {
  std::vector<ClosedLoop> closed;
  for (const Loop& loop : map.loops()) {
    const KeyframeRecord& earlier = map.records()[loop.candidate];
    if (loop.outcome != LoopOutcome::kAccepted || earlier.session < map.earlier_sessions())
      continue;
    closed.push_back({earlier.stamp, map.records()[loop.query].stamp});
  }
  return closed;
}

}  // namespace

LoopClosing::LoopClosing(const SystemConfig& config)
    : global_map_(config.global_map, with_noise(config.features, config.noise),
                  config.odometry.registration) {}

MapCorrection LoopClosing::close_loops(const GlobalKeyframe& keyframe) {
  assert(thread_.is_owner());
  const std::size_t sessions = keyframe.session + std::size_t{1};
  const bool corrected = !global_map_.add(keyframe).empty();
  if (corrected || (places_ && places_->size() < sessions)) {
    places_ = std::make_shared<const std::vector<SessionPlace>>(
        session_places(global_map_, static_cast<std::uint32_t>(sessions)));
  }
  if (corrected) {
    loops_ = std::make_shared<const std::vector<ClosedLoop>>(closed_loops(global_map_));
  }
  return {global_map_.last_correction(), places_, loops_};
}

std::optional<Relocalization> LoopClosing::relocalize(const GlobalKeyframe& frame) {
  assert(thread_.is_owner());
  return global_map_.relocalize(frame);
}

void LoopClosing::finish() {
  assert(thread_.is_owner());
  global_map_.finish();
}

const GlobalMap& LoopClosing::global_map() const {
  assert(thread_.is_owner());
  return global_map_;
}

}  // namespace mms
