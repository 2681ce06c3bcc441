#pragma once

#include <cstdint>
#include <memory>

#include "mms/simulation/simulated_scene.hpp"

namespace mms {

/// Single images to train a segmentation network with: one of the buildings with colours, stock,
/// light, exposure, lens and blur drawn at random, a camera 0.3 to 1.8 m over the floor, and up to
/// seven persons and AGVs 0.5 to 12 m before it, hidden by others and cut off by the image's
/// boundary as it happens. Image i is the same whichever were rendered before it. Not thread-safe.
class TrainingViews {
 public:
  explicit TrainingViews(std::uint64_t seed);
  ~TrainingViews();

  /// Colour image of 640 x 480, mask, exact view and objects; no depth. Poses and boxes are in the
  /// camera's frame.
  SimulatedFrame render(int index);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mms
