// Finds people and vehicles by a network in a recording, or in a simulated aisle:
//   network WEIGHTS [RECORDING]
// WEIGHTS is one of the files in share/mms/weights of the installation, or an ONNX model.

#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "mms/dataset/open_dataset.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/run/segmenter/network_detector.hpp"

namespace {

void localize(const std::string& weights, const std::string& recording) {
  const std::unique_ptr<mms::FrameSource> source = mms::open_dataset(recording);
  mms::SystemConfig config;
  config.segmentation.weights = weights;
  mms::SlamSystem system(config, mms::make_network_segmenter(config.segmentation));
  while (const std::optional<mms::Frame> frame = source->next()) {
    const mms::FrameResult result = system.process(*frame);
    const Eigen::Vector3d position = result.odometry.T_world_sensor.translation();
    std::printf("%8.4f %8.4f %8.4f m  %4.1f %% dynamic  objects %zu\n", position.x(), position.y(),
                position.z(), 100.0 * result.dynamic_share, result.objects.size());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: network WEIGHTS [RECORDING]\n");
    return 2;
  }
  try {
    localize(argv[1], argc > 2 ? argv[2] : "sim:crowd?frames=10");
  } catch (const std::exception& error) {  // mms::Error has where, what and a hint
    std::fprintf(stderr, "network: %s\n", error.what());
    return 1;
  }
  return 0;
}
