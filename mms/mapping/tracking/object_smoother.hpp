#pragma once

#include <deque>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mms/core/object_box.hpp"
#include "mms/mapping/tracking/dynamic_map.hpp"

namespace mms {

/// Positions and velocities of the dynamic map's objects, estimated with the measurements of up to
/// `history_lag` later: a fixed-lag smoother (Rauch, Tung and Striebel's recursion over the tracks'
/// filters). A track's live estimate lags where its object starts, stops or turns; the recorded one
/// does not. Keeps the filters of twice the lag; a frame costs two steps of the recursion an
/// object.
class ObjectSmoother {
 public:
  explicit ObjectSmoother(const DynamicMapConfig& config) : config_(config) {}

  /// Adds a frame's objects, in the order of stamps. A frame that is not later than the last is
  /// kept, but does not improve those before it.
  void add(Timestamp stamp, const std::vector<TrackedObject>& objects);

  /// The frames that later ones do not change any more, but those that were taken before.
  ObjectHistory take_settled() { return std::exchange(settled_, {}); }

  /// All frames so far, but those that were taken.
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
