#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "mms/core/frame.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/mask_segmenter.hpp"
#include "mms/simulation/simulated_room.hpp"

namespace mms::testing {

/// The bundled room at 320 x 240: persons and an AGV cross before a driving camera.
inline const SimulatedRoom& room() {
  static const SimulatedRoom the_room([] {
    RoomConfig config;
    config.width = 320;
    config.height = 240;
    return config;
  }());
  return the_room;
}

/// One of its frames, rendered when first asked for; from any thread.
inline const Frame& room_frame(std::size_t index) {
  static std::mutex mutex;
  static std::map<std::size_t, Frame> frames;
  const std::scoped_lock lock(mutex);
  const auto found = frames.find(index);
  if (found != frames.end()) return found->second;
  return frames.emplace(index, room().render(static_cast<int>(index))).first->second;
}

inline SlamSystem mask_system(FusionMode mode = FusionMode::kMultimodal) {
  SystemConfig config;
  config.fusion.mode = mode;
  config.fusion.stride = 1;  // the images are half the usual size
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
