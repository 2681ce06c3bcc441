#pragma once

#include "mms/core/config_visitor.hpp"

namespace mms {

struct MaskCheckConfig {
  bool enabled = true;
  double memory = 3.0;     ///< [s]
  double interval = 0.5;   ///< [s]
  double margin = 0.06;    ///< [m]
  double agreement = 0.8;  ///< of a cluster's nodes

  void visit(ConfigVisitor& v) {
    v.boolean({"enabled", "",
               "use masked points for the pose where recent views saw the same "
               "static surface"},
              enabled);
    v.number({"memory", "s", "age of the oldest view that is used"}, memory, {0.0, 60.0});
    v.number({"interval", "s", "time between the views that are used"}, interval, {0.05, 60.0});
    v.number({"margin", "m", "distance of a point from the same surface, above noise"}, margin,
             {0.005, 1.0});
    v.number({"agreement", "",
              "share of a masked cluster's known points on static surfaces that overrules it"},
             agreement, {0.5, 1.0});
  }
};

}  // namespace mms
