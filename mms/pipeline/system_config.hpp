#pragma once

#include "mms/core/config_visitor.hpp"
#include "mms/fusion/config/fusion_config.hpp"
#include "mms/geometry/sensor_noise.hpp"
#include "mms/global_map/global_map.hpp"
#include "mms/localization/features/feature_extractor.hpp"
#include "mms/localization/odometry.hpp"
#include "mms/localization/robot_body/robot_body_config.hpp"
#include "mms/mapping/motion_segmentation/mask_check_config.hpp"
#include "mms/mapping/motion_segmentation/motion_segmentation_config.hpp"
#include "mms/mapping/occupancy/occupancy_config.hpp"
#include "mms/mapping/static_map/keyframe_selector.hpp"
#include "mms/mapping/static_map/static_map.hpp"
#include "mms/mapping/tracking/dynamic_map.hpp"
#include "mms/segmentation/segmenters/segmentation_config.hpp"

namespace mms {

/// All settings of a SlamSystem, a group a module; `mms config dump` prints them with their
/// meaning.
struct SystemConfig {
  SensorNoise noise;                ///< depth_noise and lidar_noise
  bool measure_depth_noise = true;  ///< see `measured_noise`
  SegmentationConfig segmentation;  ///< of the segmenter that the program makes
  FusionConfig fusion;
  FeatureConfig features;
  OdometryConfig odometry;
  RobotBodyConfig robot_body;
  MotionSegmentationConfig motion_segmentation;
  MaskCheckConfig mask_check;
  KeyframeConfig keyframes;
  StaticMapConfig static_map;
  OccupancyConfig occupancy;
  DynamicMapConfig dynamic_map;
  GlobalMapConfig global_map;

  void visit(ConfigVisitor& v);
};

/// The settings of a module with the noise of the sensors.
template <class Config>
Config with_noise(Config config, const SensorNoise& noise) {
  config.noise = noise;
  return config;
}

}  // namespace mms
