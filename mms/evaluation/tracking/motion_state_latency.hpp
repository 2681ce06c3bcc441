#pragma once

#include <cstdint>
#include <limits>
#include <map>

#include "mms/core/time.hpp"

namespace mms {

/// Measures the delay until a start or stop of an object is recognized.
class MotionStateLatency {
 public:
  /// Adds an object in view at `stamp`.
  /// @param moving      ground truth
  /// @param recognised  whether its track agrees; false without a track
  void see(int id, Timestamp stamp, bool moving, bool recognised);

  /// Adds that an object is out of view.
  void lose(int id);

  /// Ends the recording: all objects leave the view.
  void finish();

  std::int64_t count() const { return count_; }  ///< number of starts and stops visible long enough
  double longest() const { return longest_; }    ///< [s]; NaN if none

 private:
  struct Object {
    bool moving = false;
    bool pending = false;
    Timestamp since;  ///< of the last start or stop
    Timestamp seen;
  };
  void settle(double delay);
  void count_missed(const Object& object);

  std::map<int, Object> objects_;
  std::int64_t count_ = 0;
  double longest_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace mms
