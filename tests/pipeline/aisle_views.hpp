#pragma once

#include <memory>
#include <vector>

#include "mms/global_map/global_map.hpp"
#include "mms/pipeline/perception.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {

/// An aisle with people, seen at 2 Hz.
inline SceneConfig aisle(int seed) {
  SceneConfig config = scene_config("rack_aisle");
  config.width = 320;
  config.hz = 2.0;
  config.seed = seed;
  return config;
}

inline constexpr int kSteps = 20;  // frames from one end of the path to the other

/// Perceived frames from one up to another, with the true masks.
inline std::vector<GlobalKeyframe> views_of(const SceneConfig& scene_config, int first, int end) {
  SimulatedScene scene(scene_config);
  SystemConfig config;
  Perception perception(config, std::make_unique<MaskSegmenter>());
  std::vector<GlobalKeyframe> views;
  for (int i = first; i < end; ++i) {
    const SimulatedFrame simulated = scene.render(i);
    const PerceivedFrame perceived =
        perception.perceive(simulated.frame, perception.segment(simulated.frame));
    views.push_back({simulated.frame.color, perceived.cloud, scene.truth(i).T_world_sensor, false});
  }
  return views;
}

inline std::vector<GlobalKeyframe> views_of(int seed) {
  return views_of(aisle(seed), 0, kSteps);
}

inline const std::vector<GlobalKeyframe>& views() {
  static const std::vector<GlobalKeyframe> kViews = views_of(1);
  return kViews;
}

}  // namespace mms
