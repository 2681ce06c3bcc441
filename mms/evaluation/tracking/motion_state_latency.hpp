#pragma once

#include <cstdint>
#include <limits>
#include <map>

#include "mms/core/time.hpp"

namespace mms {

/// Measures how long it takes until an object's start or stop is recognised.
class MotionStateLatency {
 public:
  /// Takes in an object that is in view at `stamp`.
  /// @param moving      whether it truly moves
  /// @param recognised  whether its track says the same; false where it has none
  void see(int id, Timestamp stamp, bool moving, bool recognised);

  /// Takes in that an object is out of view.
  void lose(int id);

  std::int64_t count() const { return count_; }  ///< starts and stops seen long enough
  double longest() const { return longest_; }    ///< [s]; NaN for none

 private:
  struct Object {
    bool moving = false;
    bool pending = false;
    Timestamp since;  ///< of the last start or stop
    Timestamp seen;
  };
  void settle(double delay);
  void give_up(const Object& object);

  std::map<int, Object> objects_;
  std::int64_t count_ = 0;
  double longest_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace mms
