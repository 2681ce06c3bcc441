#pragma once

#include <memory>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/simulation/config/scene_config.hpp"
#include "mms/simulation/sensors/exact_view.hpp"
#include "mms/simulation/sensors/sensor_preset.hpp"
#include "mms/simulation/truth/object_truth.hpp"
#include "mms/simulation/truth/truth_cloud.hpp"

namespace mms {

/// One frame as the sensor gives it, and the truth behind it.
struct SimulatedFrame {
  Frame frame;  ///< its mask has the exact labels: 0 static, else 1 + class id
  ExactView exact;
  TruthCloud scan;  ///< where the scan's points really lie, in the world frame, and on what
  std::vector<ObjectTruth> objects;  ///< all of the scene, in view or not
};

/// A warehouse with persons and AGVs, and a sensor on a robot that drives through it. Any frame can
/// be rendered at any time; the same config gives the same bits for any number of threads. Not
/// thread-safe: frames are rendered one after the other, each by all threads of the surrounding
/// arena. The world frame is the sensor's at time 0.
class SimulatedScene {
 public:
  explicit SimulatedScene(const SceneConfig& config);
  ~SimulatedScene();

  const SceneConfig& config() const;
  const SensorPreset& sensor() const;
  int size() const;  ///< number of frames
  const Calibration& calibration() const;

  SimulatedFrame render(int index);

  /// The sensor's pose at any time, between frames too.
  StampedPose pose_at(Timestamp stamp) const;
  StampedPose truth(int index) const;
  Timestamp stamp(int index) const;

  /// Everything that stands still, points at most `spacing` [m] apart on all surfaces.
  TruthCloud static_cloud(double spacing = 0.04) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mms
