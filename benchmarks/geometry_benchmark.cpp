// Searches of the local maps, on random points in a room of 6 x 3 x 5 m.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <random>
#include <vector>

#include "mms/geometry/clustering.hpp"
#include "mms/geometry/voxels/point_map.hpp"
#include "mms/geometry/voxels/voxel_downsampling.hpp"

namespace mms {
namespace {

std::vector<Eigen::Vector3f> random_points(std::size_t count) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<Eigen::Vector3f> points(count);
  for (Eigen::Vector3f& p : points) {
    p = {6.0F * unit(generator), 3.0F * unit(generator), 5.0F * unit(generator)};
  }
  return points;
}

void point_map_insert(benchmark::State& state) {
  const auto points = random_points(static_cast<std::size_t>(state.range(0)));
  for (auto unused : state) {
    PointMap map(0.1, {});
    map.insert(points);
    benchmark::DoNotOptimize(map.size());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(point_map_insert)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);

void point_map_nearest(benchmark::State& state) {
  const auto points = random_points(100'000);
  PointMap map(0.1, {});
  map.insert(points);
  std::vector<Neighbor> found;
  std::size_t i = 0;
  for (auto unused : state) {
    map.nearest(points[i++ % points.size()], 3, 0.2F, found);
    benchmark::DoNotOptimize(found.data());
  }
}
BENCHMARK(point_map_nearest)->Unit(benchmark::kMicrosecond);

void cluster(benchmark::State& state) {
  const auto points = random_points(static_cast<std::size_t>(state.range(0)));
  const std::vector<std::uint8_t> keep(points.size(), 1);
  for (auto unused : state) benchmark::DoNotOptimize(cluster_points(points, keep, 0.1F));
  state.SetComplexityN(state.range(0));
}
BENCHMARK(cluster)
    ->RangeMultiplier(4)
    ->Range(4096, 65536)
    ->Complexity(benchmark::oN)
    ->Unit(benchmark::kMillisecond);

void downsample(benchmark::State& state) {
  const auto points = random_points(100'000);
  for (auto unused : state) benchmark::DoNotOptimize(voxel_downsample(points, 0.1F));
}
BENCHMARK(downsample)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mms
