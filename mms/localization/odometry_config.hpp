#pragma once

#include "mms/core/config_visitor.hpp"
#include "mms/localization/motion/motion_model.hpp"
#include "mms/localization/registration/registration.hpp"

namespace mms {

struct OdometryConfig {
  RegistrationConfig registration;
  MotionConfig motion;
  double voxel_size = 0.0;
  double map_radius = 0.0;
  int max_voxels = 200000;
  int min_inliers = 60;
  double min_inlier_share = 0.25;

  void visit(ConfigVisitor& v);
};

}  // namespace mms
