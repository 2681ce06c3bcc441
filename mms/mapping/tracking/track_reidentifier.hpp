#pragma once

#include <optional>
#include <vector>

#include "mms/core/config.hpp"
#include "mms/mapping/tracking/track.hpp"

namespace mms {

struct ReidentificationConfig {
  double max_away = 60.0;            ///< [s]
  double spread = 0.25;              ///< [m/s]
  double new_object_density = 0.02;  ///< [1/m^2]
  double min_probability = 0.67;

  void visit(ConfigVisitor& v) {
    v.number({"max_away", "s", "longest time after which an object is known again"}, max_away,
             {0.0, 3600.0});
    v.number({"spread", "m/s", "at which its place becomes uncertain"}, spread, {0.0, 100.0});
    v.number(
        {"new_object_density", "1/m^2", "objects never seen before, over the floor", "strangers"},
        new_object_density, {1e-9, 100.0});
    v.number({"min_probability", "", "that it is the one it is taken for"}, min_probability,
             {0.5, 1.0});
  }
};

/// Objects that went out of view. A new one is one of them, by Bayes' rule, if its looks and its
/// place say so: who looks a little different is known again where he was seen a moment ago, who
/// was away for long only in the same dress.
class TrackReidentifier {
 public:
  explicit TrackReidentifier(const ReidentificationConfig& config) : config_(config) {}

  /// Keeps a track; the oldest goes when there are many.
  void add(const Track& track);

  /// Drops what was seen last too long ago.
  void forget(Timestamp now);

  /// Drops the track of that id, if it is there.
  void drop(int id);

  /// The lost track that `track` continues, which is then no longer kept.
  std::optional<Track> take(const Track& track);

 private:
  double likelihood(const Track& lost, const Track& track) const;

  ReidentificationConfig config_;
  std::vector<Track> lost_;
};

}  // namespace mms
