#pragma once

#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/mapping/tracking/track.hpp"

namespace mms {

struct AssociationConfig {
  double gate_radius = 0.8;    ///< [m]
  double max_gate = 2.0;       ///< [m]
  double class_penalty = 0.4;  ///< in gate radii
  double color_penalty = 1.0;  ///< in gate radii
  double max_color_difference = 0.7;
  double returning_color_difference = 0.5;

  void visit(ConfigVisitor& v) {
    v.number({"gate_radius", "m", "largest distance of an object from the predicted one"},
             gate_radius, {0.01, 100.0});
    v.number({"max_gate", "m", "the same after a long time unseen"}, max_gate, {0.01, 100.0});
    v.number({"class_penalty", "", "cost of another class, in gate radii"}, class_penalty,
             {0.0, 10.0});
    v.number({"color_penalty", "", "cost of no color in common, in gate radii"}, color_penalty,
             {0.0, 10.0});
    v.number({"max_color_difference", "",
              "largest one of an object, from equal (0) to none in common (1)"},
             max_color_difference, {0.0, 1.0});
    v.number({"returning_color_difference", "", "the same for an object beyond gate_radius"},
             returning_color_difference, {0.0, 1.0});
  }
};

/// Index of the track each object continues, -1 for none: the one-to-one assignment of least cost
/// (distance to the predicted position, class, colour). A pair has to be within the gate, which
/// grows with the track's uncertainty, or the object's center inside the track's box. Of several
/// clusters under one mask the largest continues a track, the others only if it does not, or if
/// they are where a known person is expected. Objects near the prediction of a confirmed track are
/// assigned first.
std::vector<int> associate(const std::vector<Track>& tracks,
                           const std::vector<ObjectMeasurement>& objects,
                           const AssociationConfig& config);

}  // namespace mms
