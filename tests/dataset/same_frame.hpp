#pragma once

#include <gtest/gtest.h>

#include "mms/core/frame.hpp"

namespace mms::testing {

/// Expects two frames to be equal to the bit.
inline void expect_same_frame(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.index, b.index);
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.depth_offset, b.depth_offset);
  EXPECT_TRUE(a.color.pixels() == b.color.pixels()) << "colors of " << a.name;
  EXPECT_TRUE(a.depth.pixels() == b.depth.pixels()) << "depth of " << a.name;
  EXPECT_TRUE(a.mask.pixels() == b.mask.pixels()) << "mask of " << a.name;
  EXPECT_TRUE(a.scan.points == b.scan.points) << "points of " << a.name;
  EXPECT_TRUE(a.scan.intensity == b.scan.intensity) << "intensities of " << a.name;
  EXPECT_TRUE(a.scan.time_offset == b.scan.time_offset) << "times of " << a.name;
  EXPECT_EQ(a.calibration->camera, b.calibration->camera);
  EXPECT_EQ(a.calibration->depth_scale, b.calibration->depth_scale);
  EXPECT_TRUE(a.calibration->T_camera_lidar.isometry().matrix() ==
              b.calibration->T_camera_lidar.isometry().matrix());
}

}  // namespace mms::testing
