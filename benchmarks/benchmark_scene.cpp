#include "benchmarks/benchmark_scene.hpp"

#include "mms/simulation/simulated_scene.hpp"

namespace mms {

const SceneRecording& scene_recording() {
  static const SceneRecording recording = [] {
    constexpr int kFrames = 60;
    SimulatedScene scene(scene_config("warehouse_loop"));
    SceneRecording result;
    for (int i = 0; i < kFrames; ++i) {
      result.frames.push_back(scene.render(i).frame);
      result.truth.push_back(scene.truth(i));
    }
    return result;
  }();
  return recording;
}

}  // namespace mms
