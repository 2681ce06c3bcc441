#pragma once

#include <deque>
#include <unordered_map>
#include <vector>

#include "mms/core/object_box.hpp"
#include "mms/mapping/tracking/dynamic_map.hpp"

namespace mms {

/// Where the dynamic map's objects were and how they moved, judged with what was seen up to `lag`
/// later: a fixed-lag smoother (Rauch, Tung and Striebel's recursion over the tracks' filters).
/// What a track is at once lags behind where its object starts, stops or turns; what is written
/// down need not. Keeps the filters of 2 `lag`; each frame costs two steps of the recursion an
/// object.
class ObjectSmoother {
 public:
  explicit ObjectSmoother(const DynamicMapConfig& config) : config_(config) {}

  /// Adds a frame's objects; frames come in the order of their stamps. One that is not later than
  /// the last is kept, but tells nothing of those before it.
  void add(Timestamp stamp, const std::vector<TrackedObject>& objects);

  /// All frames so far.
  ObjectHistory history() const;

 private:
  struct Frame {
    Timestamp stamp;
    std::vector<TrackedObject> objects;
  };

  std::deque<Frame> smoothed() const;
  void settle(double seconds);
  ObjectBox box_of(const TrackedObject& smoothed);

  DynamicMapConfig config_;
  std::deque<Frame> recent_;  ///< as the filters had them
  ObjectHistory settled_;
  std::unordered_map<int, bool> moving_;  ///< by id, in the last settled frame
};

}  // namespace mms
