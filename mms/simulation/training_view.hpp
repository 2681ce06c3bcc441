#pragma once

#include <cstdint>
#include <memory>

#include "mms/simulation/simulated_scene.hpp"

namespace mms {

/// Single images for training a segmentation network: one of the buildings with random colors,
/// stock, light, exposure, lens and blur, a camera 0.3 to 1.8 m above the floor, and up to seven
/// persons and AGVs at 0.5 to 12 m, with occlusion and truncation. Image i does not depend on
/// earlier ones. Not thread-safe.
class TrainingViews {
 public:
  explicit TrainingViews(std::uint64_t seed);
  ~TrainingViews();

  /// Color image of 640 x 480, mask, exact view and objects; no depth. Poses and boxes are in the
  /// camera frame.
  SimulatedFrame render(int index);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mms
