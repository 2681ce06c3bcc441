#pragma once

#include <memory>
#include <string>

#include "mms/server/scene/viewer_scene.hpp"

namespace mms::testing {

/// A frame at `index` / 10 s, `index` metres along x, with one object.
inline SceneFrame frame_at(std::size_t index) {
  SceneFrame frame;
  frame.stamp = Timestamp(static_cast<std::int64_t>(index) * 100'000'000);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = static_cast<double>(index);
  frame.T_world_sensor = Transform<World, Sensor>(pose);
  frame.series = {static_cast<float>(index), 0.5F};
  ObjectBox box;
  box.id = 7;
  box.object_class = ObjectClass::kAgv;
  box.T_world_box.translation() = Eigen::Vector3d(1.0, 2.0, 3.0);
  frame.objects = {box};
  frame.truth = Eigen::Vector3d(static_cast<double>(index), 0.25, 0.0);
  return frame;
}

inline SceneInfo scene_info(bool live) {
  SceneInfo info;
  info.id = "test-1";
  info.name = "test";
  info.data = "sim:test";
  info.live = live;
  info.has_truth = true;
  info.has_pictures = false;
  info.voxel_size = 0.1;
  info.series = {{"read", "ms"}, {"dynamic_share", "ratio"}};
  return info;
}

/// Points on a plane at z = 0.55, one per voxel of 0.1 m.
inline ColoredPoints floor_points(int side) {
  ColoredPoints cloud;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      cloud.points.emplace_back(0.1F * static_cast<float>(x) + 0.05F,
                                0.1F * static_cast<float>(y) + 0.05F, 0.55F);
      cloud.colors.push_back({static_cast<std::uint8_t>(x % 256), 100, 200});
    }
  }
  return cloud;
}

inline std::shared_ptr<const MapChanges> floor_map(int side) {
  const ColoredPoints cloud = floor_points(side);
  return std::make_shared<const MapChanges>(changes_of(cloud.points, cloud.colors, 0.1));
}

/// A finished run of `frames` frames with a floor as its map, without pictures.
inline std::shared_ptr<Scene> finished_scene(std::size_t frames,
                                             const std::filesystem::path& folder = "/nowhere") {
  SceneInfo info = scene_info(false);
  info.frames = frames;
  auto scene = std::make_shared<Scene>(info);
  for (std::size_t i = 0; i < frames; ++i) scene->add(frame_at(i), nullptr, nullptr);
  scene->add_map(floor_map(20));
  scene->end(folder);
  return scene;
}

/// View of a sensor: a cloud of 4 x 2 pixels, the last one dynamic.
inline std::shared_ptr<const SensorView> view_of(std::size_t frame) {
  auto view = std::make_shared<SensorView>();
  view->frame = frame;
  view->color = Image<Rgb>(8, 4, Rgb{10, 20, 30});
  LabeledCloud& cloud = view->cloud;
  cloud.width = 4;
  cloud.height = 2;
  cloud.points.assign(8, Eigen::Vector3f(0.0F, 0.0F, static_cast<float>(frame)));
  cloud.labels.assign(8, PointLabel::kStatic);
  cloud.labels[0] = PointLabel::kInvalid;
  cloud.labels[7] = PointLabel::kDynamic;
  cloud.colors.assign(8, Rgb{1, 2, 3});
  cloud.cluster.assign(8, -1);
  cloud.cluster[7] = 0;
  cloud.clusters.resize(1);
  cloud.clusters[0].object_class = ObjectClass::kAgv;
  return view;
}

}  // namespace mms::testing
