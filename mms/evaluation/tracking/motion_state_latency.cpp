#include "mms/evaluation/tracking/motion_state_latency.hpp"

namespace mms {
namespace {

/// Unrecognized changes count if they were visible for this time [s].
constexpr double kLongEnough = 1.0;

}  // namespace

void MotionStateLatency::see(int id, Timestamp stamp, bool moving, bool recognised) {
  const auto [place, is_new] = objects_.try_emplace(id, Object{moving, false, stamp, stamp});
  Object& object = place->second;
  if (!is_new && moving != object.moving) {
    if (object.pending) count_missed(object);
    object = {moving, true, stamp, stamp};
  }
  object.seen = stamp;
  if (!object.pending || !recognised) return;
  settle(to_seconds(stamp - object.since));
  object.pending = false;
}

void MotionStateLatency::lose(int id) {
  const auto place = objects_.find(id);
  if (place == objects_.end()) return;
  if (place->second.pending) count_missed(place->second);
  objects_.erase(place);
}

void MotionStateLatency::finish() {
  while (!objects_.empty()) lose(objects_.begin()->first);
}

void MotionStateLatency::settle(double delay) {
  ++count_;
  if (!(delay <= longest_)) longest_ = delay;
}

void MotionStateLatency::count_missed(const Object& object) {
  const double waited = to_seconds(object.seen - object.since);
  if (waited >= kLongEnough) settle(waited);
}

}  // namespace mms
