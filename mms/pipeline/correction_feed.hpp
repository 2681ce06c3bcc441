#pragma once

#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/pipeline/session_places.hpp"

namespace mms {

/// A loop within the run, by the stamps of its keyframes.
struct ClosedLoop {
  Timestamp earlier;
  Timestamp later;
};

/// What loop closure knows of the map so far.
struct MapCorrection {
  /// Pose of the odometry's world frame in that of the map; nothing until the place in an earlier
  /// map is recognized.
  std::optional<Transform<Global, World>> T_global_world{};
  /// Places of the run's sessions; null before the first loop.
  std::shared_ptr<const std::vector<SessionPlace>> places{};
  /// Loops so far; null before the first one.
  std::shared_ptr<const std::vector<ClosedLoop>> loops{};
};

/// Takes the results of loop closure, which runs beside the odometry, to the frames that follow.
class CorrectionFeed {
 public:
  /// @param first  for frames before any result
  explicit CorrectionFeed(const MapCorrection& first) : current_(first) {}

  /// Whether to wait for results that are late, so that they do not depend on the computer.
  void set_waiting(bool waits) { waits_ = waits; }

  /// Frames of a new session follow.
  /// @param first  for those before any result
  void reset(const std::optional<Transform<Global, World>>& first) {
    current_.T_global_world = first;
    coming_.clear();
  }

  /// Adds the result of a keyframe, later than those before.
  void add(Timestamp keyframe, std::future<MapCorrection> result) {
    coming_.push_back({keyframe, std::move(result)});
  }

  /// The correction for a frame: of the last keyframe that is old enough, or, without waiting, of
  /// the last one that is ready.
  /// @throws what the loop closure threw
  const MapCorrection& at(Timestamp frame);

 private:
  struct Coming {
    Timestamp keyframe;
    std::future<MapCorrection> result;
  };

  MapCorrection current_;
  std::deque<Coming> coming_;
  bool waits_ = true;
};

}  // namespace mms
