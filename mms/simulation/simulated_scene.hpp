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

/// One frame of the sensor with its ground truth.
struct SimulatedFrame {
  Frame frame;  ///< its mask has the exact labels: 0 static, else 1 + class id
  ExactView exact;
  TruthCloud scan;  ///< exact positions and labels of the scan's points, world frame
  std::vector<ObjectTruth> objects;  ///< all of the scene, in view or not
};

/// A warehouse with persons, AGVs and a sensor on a moving robot. Frames can be rendered in any
/// order; the same config gives the same bits for any number of threads. Not thread-safe: frames
/// are rendered one at a time, each by all threads of the current arena. The world frame is the
/// sensor's at time 0.
class SimulatedScene {
 public:
  explicit SimulatedScene(const SceneConfig& config);
  ~SimulatedScene();

  const SceneConfig& config() const;
  const SensorPreset& sensor() const;
  int size() const;  ///< number of frames
  const Calibration& calibration() const;

  SimulatedFrame render(int index);

  /// The sensor's pose at any time, including between frames.
  StampedPose pose_at(Timestamp stamp) const;
  StampedPose truth(int index) const;
  Timestamp stamp(int index) const;

  /// What wheels and gyroscope measure over the whole scene; empty for those that are disabled.
  MotionSamples motion() const;

  /// All static surfaces, with points at most `spacing` [m] apart.
  TruthCloud static_cloud(double spacing = 0.04) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mms
