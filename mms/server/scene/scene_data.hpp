#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/object_box.hpp"
#include "mms/core/odometry_estimate.hpp"

namespace mms {

/// A number a frame has, drawn over time. Its unit is "" where it has none.
struct SeriesName {
  std::string name;
  std::string unit;
};

/// What viewers are told of a run once.
struct SceneInfo {
  std::string id;     ///< of this run and no other
  std::string name;   ///< for the title
  std::string data;   ///< what was run, in the user's words
  bool live = false;  ///< frames still come
  std::optional<CameraIntrinsics> camera;
  std::optional<std::size_t> frames;  ///< how many there will be, where that is known
  bool has_truth = false;
  bool has_pictures = true;            ///< images, masks and scans can be shown
  std::string pictures_note;           ///< why they cannot
  double voxel_size = 0.0;             ///< of the map [m]
  Eigen::Vector3d up{0.0, -1.0, 0.0};  ///< in the world frame, unit
  std::vector<SeriesName> series;
};

/// What viewers are shown of one frame, without what its sensor gave.
struct SceneFrame {
  Timestamp stamp;
  Transform<World, Sensor> T_world_sensor;
  Status status = Status::kTracking;
  std::vector<float> series;             ///< parallel to SceneInfo::series; NaN: not known
  std::vector<ObjectBox> objects;        ///< `visible` is 0 where the frame does not show it
  std::optional<Eigen::Vector3d> truth;  ///< true position in the world frame [m]
};

/// Successive frames, shared with whoever reads them while more come.
using SceneFrames = std::vector<std::shared_ptr<const SceneFrame>>;

/// What the sensor gave at a frame, and what was found in it.
struct SensorView {
  std::size_t frame = 0;  ///< its position in the run
  Image<Rgb> color;       ///< may be empty
  LabeledCloud cloud;
};

/// Points with colours; the vectors are parallel.
struct ColoredPoints {
  std::vector<Eigen::Vector3f> points;  ///< [m]
  std::vector<Rgb> colors;
};

}  // namespace mms
