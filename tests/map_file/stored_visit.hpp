#pragma once

#include <filesystem>
#include <string>

#include "mms/core/random_stream.hpp"
#include "mms/map_file/map_file.hpp"
#include "mms/pipeline/system_config.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/pipeline/aisle_views.hpp"

namespace mms::testing {

inline GlobalMap empty_map() {
  GlobalMapConfig config;
  config.min_path = 2.0;
  const SystemConfig system;
  return GlobalMap(config, system.features, system.odometry.registration);
}

/// Adds views of the aisle, from one of its steps to another, in a world of their own.
/// @param T_world_scene  the world of these views
inline void drive(GlobalMap& map, int first, int end, const Eigen::Isometry3d& T_world_scene) {
  const int step = first < end ? 1 : -1;
  for (int i = first; i != end; i += step) {
    GlobalKeyframe keyframe = views()[static_cast<std::size_t>(i)];
    keyframe.T_world_sensor =
        Transform<World, Sensor>(T_world_scene * keyframe.T_world_sensor.isometry());
    keyframe.cloud.stamp = Timestamp((map.records().size() + 1) * 500'000'000);
    map.add(keyframe);
  }
  map.finish();
}

/// A world that has nothing in common with that of the scene.
inline Eigen::Isometry3d other_world() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(2.0, Eigen::Vector3d(0.1, 1.0, -0.2).normalized()).matrix();
  T.translation() = Eigen::Vector3d(5.0, -1.0, 30.0);
  return T;
}

/// Random points, measured at the stamps of the keyframes of the present session.
inline StampedMap some_surfaces(const GlobalMap& map, std::size_t count, std::uint64_t seed) {
  RandomStream random(seed);
  StampedMap surfaces;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = [&] { return random.between(-3.0F, 3.0F); };
    surfaces.cloud.points.emplace_back(number(), number(), number());
    surfaces.cloud.normals.push_back(Eigen::Vector3f(number(), number(), number()).normalized());
    surfaces.cloud.colors.push_back({static_cast<std::uint8_t>(random.below(256)), 20, 30});
    surfaces.cloud.observations.push_back(1 + static_cast<int>(random.below(9)));
    surfaces.stamps.push_back(map.records()[random.below(map.records().size())].stamp);
  }
  return surfaces;
}

inline MapSession some_session(const std::string& name) {
  return {name,
          "0.1",
          "key: value\n",
          20,
          Timestamp(500'000'000),
          Timestamp(900'000'000),
          0.02,
          {300.0, 300.0, 159.5, 119.5, 320, 240, {}}};
}

/// A map of one session over the whole aisle.
inline void write_first_session(const std::filesystem::path& path) {
  GlobalMap map = empty_map();
  drive(map, 0, kSteps, Eigen::Isometry3d::Identity());
  MapFile file(path, MapFile::Mode::kCreate);
  file.add_session(some_session("first"), some_surfaces(map, 5000, 1), map.records());
  file.set_graph(map.poses(), map.loops());
  file.commit();
}

inline void refuse(const std::string& warning) {
  throw std::runtime_error("unexpected: " + warning);
}

}  // namespace mms::testing
