#pragma once

#include "mms/core/config_visitor.hpp"

namespace mms {

struct MotionSegmentationConfig {
  bool enabled = true;
  double memory = 3.0;     ///< [s]
  double interval = 0.5;   ///< [s]
  double margin = 0.15;    ///< [m]
  double radius = 0.08;    ///< [m]
  double max_share = 0.6;  ///< of the static points

  void visit(ConfigVisitor& v) {
    v.boolean(
        {"enabled", "", "label points in observed free space as dynamic, with or without a mask"},
        enabled);
    v.number({"memory", "s", "age of the oldest view that is used"}, memory, {0.0, 60.0});
    v.number({"interval", "s", "time between the views that are used"}, interval, {0.05, 60.0});
    v.number({"margin", "m", "distance behind a point that a view must have measured, above noise"},
             margin, {0.01, 10.0});
    v.number({"radius", "m", "of the disc that an object must cover in a depth image"}, radius,
             {0.01, 10.0});
    v.number({"max_share", "",
              "of the static points; with more, the pose is wrong and none is relabeled"},
             max_share, {0.0, 1.0});
  }
};

}  // namespace mms
