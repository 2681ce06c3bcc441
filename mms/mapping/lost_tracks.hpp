#pragma once

#include <optional>
#include <vector>

#include "mms/core/config.hpp"
#include "mms/mapping/track.hpp"

namespace mms {

struct ReturnConfig {
  double max_away = 60.0;              ///< [s]
  double max_color_difference = 0.04;  ///< from black (0) to white (1)
  double speed = 1.5;                  ///< [m/s]

  void visit(ConfigVisitor& v) {
    v.number({"max_away", "s", "longest time after which an object is known again"}, max_away,
             {0.0, 3600.0});
    v.number({"max_color_difference", "", "largest one of an object that is known again"},
             max_color_difference, {0.0, 1.0});
    v.number({"speed", "m/s", "at which it may have gone on unseen"}, speed, {0.0, 100.0});
  }
};

/// Objects that went out of view. A new one that looks like one of them, and like no other, and
/// could have come from where that was seen last, is that one.
class LostTracks {
 public:
  explicit LostTracks(const ReturnConfig& config) : config_(config) {}

  /// Keeps a track; the oldest goes when there are many.
  void add(const Track& track);

  /// Drops what was seen last too long ago.
  void forget(Timestamp now);

  /// Drops the track of that id, if it is there.
  void drop(int id);

  /// The lost track that `track` continues, which is then no longer kept.
  std::optional<Track> take(const Track& track);

 private:
  bool could_be(const Track& lost, const Track& track) const;

  ReturnConfig config_;
  std::vector<Track> lost_;
};

}  // namespace mms
