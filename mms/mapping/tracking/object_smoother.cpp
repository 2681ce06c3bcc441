#include "mms/mapping/tracking/object_smoother.hpp"

#include <limits>
#include <utility>

namespace mms {

void ObjectSmoother::add(Timestamp stamp, const std::vector<TrackedObject>& objects) {
  recent_.push_back({stamp, objects});
  if (to_seconds(stamp - recent_.front().stamp) >= 2.0 * config_.history_lag) {
    settle(config_.history_lag);
  }
}

ObjectHistory ObjectSmoother::history() const {
  ObjectSmoother all = *this;
  all.settle(std::numeric_limits<double>::lowest());
  return std::move(all.settled_);
}

/// The recent frames, each improved by those after it.
std::deque<ObjectSmoother::Frame> ObjectSmoother::smoothed() const {
  struct Later {
    Timestamp stamp;
    const MotionFilter* motion = nullptr;
  };
  std::unordered_map<int, Later> later_of;
  std::deque<Frame> frames = recent_;
  for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame) {
    for (TrackedObject& object : frame->objects) {
      const auto later = later_of.find(object.box.id);
      if (later != later_of.end() && later->second.stamp > frame->stamp) {
        object.motion.smooth(*later->second.motion, to_seconds(later->second.stamp - frame->stamp),
                             config_.track.acceleration_noise);
      }
      later_of[object.box.id] = {frame->stamp, &object.motion};
    }
  }
  return frames;
}

/// Moves all recent frames but those of the last `seconds` to the history.
void ObjectSmoother::settle(double seconds) {
  if (recent_.empty()) return;
  const Timestamp newest = recent_.back().stamp;
  for (const Frame& frame : smoothed()) {
    if (to_seconds(newest - frame.stamp) < seconds) break;
    ObjectFrame& settled = settled_.emplace_back(ObjectFrame{frame.stamp, {}});
    for (const TrackedObject& object : frame.objects) settled.objects.push_back(box_of(object));
    recent_.pop_front();
  }
}

ObjectBox ObjectSmoother::box_of(const TrackedObject& smoothed) {
  ObjectBox box = smoothed.box;
  box.T_world_box.translation() = smoothed.motion.position();
  box.velocity = smoothed.motion.velocity();
  bool& moving = moving_.try_emplace(box.id, box.moving).first->second;
  moving = config_.track.is_moving(box.velocity.norm(), moving);
  box.moving = moving;
  return box;
}

}  // namespace mms
