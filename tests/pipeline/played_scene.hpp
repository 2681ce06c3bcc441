#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "mms/core/frame.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms::testing {

/// A warehouse at 320 x 240: persons and vehicles cross close before a driving camera.
inline SceneConfig played_config() {
  SceneConfig config = scene_config("crowd");
  config.width = 320;
  config.speed = 0.3;
  return config;
}

inline SimulatedScene& scene() {
  static SimulatedScene the_scene(played_config());
  return the_scene;
}

/// One of its frames with its truth, rendered when first asked for; from any thread.
inline const SimulatedFrame& simulated_frame(std::size_t index) {
  static std::mutex mutex;
  static std::map<std::size_t, SimulatedFrame> frames;
  const std::scoped_lock lock(mutex);
  const auto found = frames.find(index);
  if (found != frames.end()) return found->second;
  return frames.emplace(index, scene().render(static_cast<int>(index))).first->second;
}

inline const Frame& scene_frame(std::size_t index) {
  return simulated_frame(index).frame;
}

inline SlamSystem mask_system(FusionMode mode = FusionMode::kMultimodal) {
  SystemConfig config;
  config.fusion.mode = mode;
  return SlamSystem(config, std::make_unique<MaskSegmenter>());
}

/// What has to be the same bits however a frame was processed.
inline bool same_bits(const FrameResult& a, const FrameResult& b) {
  return a.odometry.T_world_sensor.isometry().matrix() ==
             b.odometry.T_world_sensor.isometry().matrix() &&
         a.odometry.information == b.odometry.information &&
         a.odometry.status == b.odometry.status && a.odometry.stamp == b.odometry.stamp &&
         a.cloud.labels == b.cloud.labels && a.cloud.cluster == b.cloud.cluster &&
         a.keyframe == b.keyframe && a.dynamic_share == b.dynamic_share;
}

}  // namespace mms::testing
