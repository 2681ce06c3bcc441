// Time of a frame in C++ beyond its stages, for benchmarks/python.sh: the same frames and settings.
// usage: mms_frame_cost RECORDING
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "mms/dataset/open_dataset.hpp"
#include "mms/geometry/noise_measurement.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"

namespace {

int run(const char* recording) {
  const auto dataset = mms::open_dataset(recording, {});
  std::vector<mms::Frame> frames;
  while (auto frame = dataset->next()) frames.push_back(std::move(*frame));
  mms::SystemConfig config;
  config.global_map.enabled = false;
  // As Python does.
  config.noise.depth = mms::measured_noise(config.noise.depth, frames.at(0).depth);
  if (const auto max_depth = frames.at(0).calibration->max_depth) {
    config.static_map.surface.max_depth = *max_depth;
  }
  mms::SlamSystem system(config, std::make_unique<mms::MaskSegmenter>());
  std::vector<double> more;  // [ms]
  double whole = 0.0;        // [ms]
  mms::FrameResult result;
  for (const mms::Frame& frame : frames) {
    const auto begin = std::chrono::steady_clock::now();
    result = system.process(frame);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    whole += time.count();
    const auto& stages = result.stage_ms;
    more.push_back(time.count() - std::accumulate(stages.begin(), stages.end(), 0.0));
  }
  std::sort(more.begin(), more.end());
  const auto count = static_cast<double>(more.size());
  std::printf("C++            %.3f ms median, %.3f mean, %.3f p99 of %.2f ms per frame\n",
              more[more.size() / 2], std::accumulate(more.begin(), more.end(), 0.0) / count,
              more[more.size() * 99 / 100], whole / count);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: mms_frame_cost RECORDING\n");
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
