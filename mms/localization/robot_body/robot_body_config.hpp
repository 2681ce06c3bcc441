#pragma once

#include "mms/core/config_visitor.hpp"

namespace mms {

struct RobotBodyConfig {
  bool enabled = true;
  double max_distance = 1.5;  ///< [m]

  void visit(ConfigVisitor& v) {
    v.boolean({"enabled", "",
               "ignore parts of the robot in the view of a depth camera, which stay the same while "
               "it moves"},
              enabled);
    v.number({"max_distance", "m", "depth up to which they are searched for"}, max_distance,
             {0.1, 10.0});
  }
};

}  // namespace mms
