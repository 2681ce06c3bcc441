// Localizes a recording, or a simulated warehouse aisle with people, and prints a pose per frame:
//   minimal [RECORDING]

#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "mms/dataset/open_dataset.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"

namespace {

void print(const mms::Frame& frame, const mms::FrameResult& result) {
  const Eigen::Vector3d position = result.odometry.T_world_sensor.translation();
  const std::string status(to_string(result.odometry.status));
  std::printf("%s  %8.4f %8.4f %8.4f m  %4.1f %% dynamic  %s\n", frame.stamp.to_string().c_str(),
              position.x(), position.y(), position.z(), 100.0 * result.dynamic_share,
              status.c_str());
}

void localize(const std::string& recording) {
  const std::unique_ptr<mms::FrameSource> source = mms::open_dataset(recording);
  source->on_warning([](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); });

  mms::SystemConfig config;
  config.static_map.voxel_size = 0.03;
  mms::SlamSystem system(config, std::make_unique<mms::MaskSegmenter>());
  while (const std::optional<mms::Frame> frame = source->next()) {
    print(*frame, system.process(*frame));
  }

  std::printf("static map: %zu points, without %d people and vehicles\n",
              system.static_map().cloud().points.size(), system.dynamic_map().confirmed());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    localize(argc > 1 ? argv[1] : "sim:rack_aisle?frames=10");
  } catch (const std::exception& error) {  // mms::Error has where, what and a hint
    std::fprintf(stderr, "minimal: %s\n", error.what());
    return 1;
  }
  return 0;
}
