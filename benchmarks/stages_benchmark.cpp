// Every stage of the pipeline in the simulated warehouse (640x480, people and vehicles in view).

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <memory>

#include "benchmarks/benchmark_scene.hpp"
#include "mms/evaluation/trajectory/trajectory_error.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"

namespace mms {
namespace {

/// The frames in sequence, repeated.
const Frame& frame_of(std::size_t iteration) {
  const auto& frames = scene_recording().frames;
  return frames[iteration % frames.size()];
}

void segmentation_masks(benchmark::State& state) {
  scene_recording();  // rendered before the measurement starts
  MaskSegmenter segmenter;
  std::size_t i = 0;
  for (auto unused : state) benchmark::DoNotOptimize(segmenter.segment(frame_of(i++)));
}
BENCHMARK(segmentation_masks)->Unit(benchmark::kMillisecond);

void fusion(benchmark::State& state, FusionMode mode) {
  FusionConfig config;
  config.mode = mode;
  SemanticFusion fusion(config);
  MaskSegmenter segmenter;
  std::size_t i = 0;
  double share = 0.0;
  for (auto unused : state) {
    const Frame& frame = frame_of(i++);
    const LabeledCloud cloud = fusion.fuse(frame, segmenter.segment(frame));
    share += dynamic_share(cloud);
  }
  state.counters["dynamic_percent"] = 100.0 * share / static_cast<double>(i);
}
BENCHMARK_CAPTURE(fusion, none, FusionMode::kNone)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fusion, vision, FusionMode::kVision)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fusion, multimodal, FusionMode::kMultimodal)->Unit(benchmark::kMillisecond);

/// Labeled clouds of the whole recording, computed once.
const std::vector<LabeledCloud>& labeled_clouds() {
  static const std::vector<LabeledCloud> clouds = [] {
    SemanticFusion fusion(FusionConfig{});
    MaskSegmenter segmenter;
    std::vector<LabeledCloud> result;
    for (const Frame& frame : scene_recording().frames) {
      result.push_back(fusion.fuse(frame, segmenter.segment(frame)));
    }
    return result;
  }();
  return clouds;
}

void features(benchmark::State& state) {
  const FeatureExtractor extractor{FeatureConfig{}};
  const auto& clouds = labeled_clouds();
  std::size_t i = 0;
  double edges = 0.0;
  double planes = 0.0;
  for (auto unused : state) {
    const FeatureCloud found = extractor.extract(clouds[i++ % clouds.size()]);
    edges += static_cast<double>(found.edges.size());
    planes += static_cast<double>(found.planes.size());
  }
  state.counters["edges"] = edges / static_cast<double>(i);
  state.counters["planes"] = planes / static_cast<double>(i);
}
BENCHMARK(features)->Unit(benchmark::kMillisecond);

double ate_cm(const Trajectory& estimate) {
  return 100.0 * evaluate_trajectory(scene_recording().truth, estimate).ate_rmse_m;
}

/// One iteration is the whole recording; the reported time is per frame.
void odometry(benchmark::State& state, Association association, bool photometric) {
  const FeatureExtractor extractor{FeatureConfig{}};
  std::vector<FeatureCloud> all;
  for (const LabeledCloud& cloud : labeled_clouds()) all.push_back(extractor.extract(cloud));
  OdometryConfig config;
  config.registration.geometric.association = association;
  config.registration.photometric.enabled = photometric;
  Trajectory estimate;
  for (auto unused : state) {
    Odometry odometry(config, DepthNoise{});
    estimate.clear();
    for (const FeatureCloud& cloud : all) {
      estimate.push_back({cloud.stamp, odometry.estimate(cloud).T_world_sensor});
    }
  }
  state.counters["ate_cm"] = ate_cm(estimate);
  state.counters["s_per_frame"] = benchmark::Counter(
      static_cast<double>(all.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(odometry, surface_photometric, Association::kSurface, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(odometry, surface, Association::kSurface, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(odometry, paper_photometric, Association::kPaper, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(odometry, paper, Association::kPaper, false)->Unit(benchmark::kMillisecond);

void static_map_keyframe(benchmark::State& state) {
  const auto& clouds = labeled_clouds();
  const auto& truth = scene_recording().truth;
  StaticMap map;
  std::size_t i = 0;
  for (auto unused : state) {
    const std::size_t k = i++ % clouds.size();
    benchmark::DoNotOptimize(map.integrate(clouds[k], truth[k].T_world_sensor));
  }
  state.counters["voxels"] = static_cast<double>(map.size());
  state.counters["MB"] = static_cast<double>(map.memory_bytes()) * 1e-6;
}
BENCHMARK(static_map_keyframe)->Unit(benchmark::kMillisecond);

void occupancy_keyframe(benchmark::State& state) {
  const auto& clouds = labeled_clouds();
  const auto& truth = scene_recording().truth;
  OccupancyMap map;
  std::size_t i = 0;
  for (auto unused : state) {
    const std::size_t k = i++ % clouds.size();
    map.integrate(clouds[k], truth[k].T_world_sensor);
  }
  state.counters["MB"] = static_cast<double>(map.blocks().memory_bytes()) * 1e-6;
}
BENCHMARK(occupancy_keyframe)->Unit(benchmark::kMillisecond);

void whole_pipeline(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  Trajectory estimate;
  for (auto unused : state) {
    SlamSystem system({}, std::make_unique<MaskSegmenter>());
    estimate.clear();
    for (const Frame& frame : scene_recording().frames) {
      const FrameResult result = system.process(frame);
      estimate.push_back({frame.stamp, result.odometry.T_world_sensor});
    }
  }
  state.counters["ate_cm"] = ate_cm(estimate);
  state.counters["s_per_frame"] = benchmark::Counter(
      static_cast<double>(estimate.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(whole_pipeline)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace mms
