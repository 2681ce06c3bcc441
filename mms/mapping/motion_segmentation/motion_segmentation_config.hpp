#pragma once

#include "mms/core/config.hpp"

namespace mms {

struct MotionSegmentationConfig {
  bool enabled = true;
  double memory = 3.0;     ///< [s]
  double interval = 0.5;   ///< [s]
  double margin = 0.15;    ///< [m]
  double radius = 0.08;    ///< [m]
  double max_share = 0.6;  ///< of the static points

  void visit(ConfigVisitor& v) {
    v.boolean({"enabled", "", "take what stands where space was free for dynamic, mask or not"},
              enabled);
    v.number({"memory", "s", "how long free space is remembered"}, memory, {0.0, 60.0});
    v.number({"interval", "s", "time between the views that are remembered"}, interval,
             {0.05, 60.0});
    v.number({"margin", "m", "how far behind a point a view has to have seen, above noise"}, margin,
             {0.01, 10.0});
    v.number({"radius", "m", "of the largest disc that fits into what a depth image shows of it"},
             radius, {0.01, 10.0});
    v.number({"max_share", "", "of the static points; more is an error of the pose"}, max_share,
             {0.0, 1.0});
  }
};

}  // namespace mms
