#pragma once

#include "mms/core/config_visitor.hpp"

namespace mms {

/// The photometric term and its keyframes.
struct PhotometricConfig {
  bool enabled = true;
  bool hold_still = true;
  double min_gradient = 6.0;
  int cell_px = 3;
  double min_sigma = 3.0;
  double weight = 1.0;
  double depth_gate = 0.05;
  int references = 4;
  double keyframe_translation = 0.08;
  double keyframe_parallax = 0.04;
  double keyframe_rotation = 7.0;
  int max_keyframes = 100;

  void visit(ConfigVisitor& v);
};

}  // namespace mms
