#pragma once

#include <optional>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/mapping/tracking/track.hpp"

namespace mms {

struct ReidentificationConfig {
  double max_away = 60.0;            ///< [s]
  double spread = 0.25;              ///< [m/s]
  double new_object_density = 0.02;  ///< [1/m^2]
  double min_probability = 0.67;

  void visit(ConfigVisitor& v) {
    v.number({"max_away", "s", "longest absence after which an object gets its former id"},
             max_away, {0.0, 3600.0});
    v.number({"spread", "m/s", "growth of its position's standard deviation while unseen"}, spread,
             {0.0, 100.0});
    v.number({"new_object_density", "1/m^2", "density of objects never seen before", "strangers"},
             new_object_density, {1e-9, 100.0});
    v.number({"min_probability", "", "least probability of the match"}, min_probability,
             {0.5, 1.0});
  }
};

/// Reidentifies objects that left the view, by Bayes' rule over appearance and position: after a
/// short time and nearby a moderate difference of appearance is accepted, after a long time none.
class TrackReidentifier {
 public:
  explicit TrackReidentifier(const ReidentificationConfig& config) : config_(config) {}

  /// Keeps a track; drops the oldest when there are too many.
  void add(const Track& track);

  /// Drops tracks that were last seen more than `max_away` ago.
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
